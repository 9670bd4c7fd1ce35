#pragma once

#include <concepts>
#include <limits>
#include <optional>

namespace trivela::kicking {

/// A number that may be missing, in the form that a message has: NaN is none, and so is an infinity that it is made of.
/// It is read as std::optional<double> is, and one of a message goes into the next as it came (docs/decisions/0063).
class OptionalDouble {
 public:
  constexpr OptionalDouble() = default;
  constexpr OptionalDouble(std::nullopt_t) {}
  constexpr OptionalDouble(double number) : number_(number - number == 0.0 ? number : kNone) {}

  [[nodiscard]] constexpr bool has_value() const { return number_ == number_; }
  constexpr explicit operator bool() const { return has_value(); }

  /// The number; NaN where there is none.
  constexpr double operator*() const { return number_; }
  /// Throws std::bad_optional_access where there is none.
  [[nodiscard]] constexpr double value() const { return has_value() ? number_ : throw std::bad_optional_access{}; }
  [[nodiscard]] constexpr double value_or(double other) const { return has_value() ? number_ : other; }

  /// For a message.
  [[nodiscard]] constexpr double to_message() const { return number_; }
  /// What is no message, a log's cell or a document, has another form.
  constexpr OptionalDouble(const std::optional<double>& number) : OptionalDouble(number.value_or(kNone)) {}
  constexpr operator std::optional<double>() const { return has_value() ? std::optional{number_} : std::nullopt; }

  friend constexpr bool operator==(OptionalDouble a, OptionalDouble b) {
    return a.has_value() == b.has_value() && (!a.has_value() || *a == *b);
  }
  /// std's own would compare the number alone, and none with none be false.
  template <std::same_as<std::optional<double>> Optional>
  friend constexpr bool operator==(OptionalDouble, const Optional&) = delete;
  template <std::same_as<std::optional<double>> Optional>
  friend constexpr bool operator==(const Optional&, OptionalDouble) = delete;

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double number_ = kNone;
};

}  // namespace trivela::kicking
