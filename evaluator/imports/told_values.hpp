#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace trivela::evaluator::imports {

/// A value of a worldstate that is neither object nor array.
struct Scalar {
  enum class Kind { kNull, kTruth, kWhole, kReal, kText };
  Kind kind = Kind::kNull;
  double number = 0.0;      ///< of a truth 0 or 1
  std::string_view text{};  ///< valid while it is handled

  bool is_number() const { return kind == Kind::kWhole || kind == Kind::kReal; }
  std::string shown() const {
    return kind == Kind::kNull    ? "null"
           : kind == Kind::kText  ? std::string(text)
           : kind == Kind::kTruth ? (number != 0.0 ? "true" : "false")
           : kind == Kind::kReal  ? fmt::format("{:#}", number)
                                  : fmt::format("{:.0f}", number);
  }
};

/// An array of numbers such as a pose: the first three, an empty one where there was none.
struct Numbers {
  std::array<std::optional<double>, 3> at{};
  std::size_t size = 0;  ///< as it was sent

  void add(std::optional<double> number) {
    if (size < at.size()) at[size] = number;
    ++size;
  }
  bool has(std::size_t n) const {
    for (std::size_t i = 0; i < n; ++i)
      if (!at[i]) return false;
    return true;
  }
};

}  // namespace trivela::evaluator::imports
