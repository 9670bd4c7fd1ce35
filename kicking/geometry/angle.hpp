#pragma once

#include <cmath>
#include <numbers>

namespace trivela::kicking {

/// Degrees to radians; degrees exist in TOML and on the command line only.
constexpr double radians(double angle_deg) { return angle_deg * std::numbers::pi / 180.0; }

/// Radians to degrees.
constexpr double degrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

/// The same direction in [-pi, pi]. NaN stays NaN.
inline double wrap_angle(double angle_rad) {
  if (std::abs(angle_rad) <= std::numbers::pi) return angle_rad;  // what remainder() gives, without its cost
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

}  // namespace trivela::kicking
