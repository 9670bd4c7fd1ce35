#pragma once

#include <cmath>
#include <limits>
#include <optional>

namespace trivela::msg {

/// What a message's number holds where there is none.
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A number of the wire that may be missing; what is not finite is none.
[[nodiscard]] inline std::optional<double> optional_of(double wire) {
  return std::isfinite(wire) ? std::optional{wire} : std::nullopt;
}

/// A number that may be missing, for the wire.
[[nodiscard]] constexpr double wire_of(const std::optional<double>& number) { return number.value_or(kNone); }

}  // namespace trivela::msg
