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

/// An angle over the floor with its sine and cosine, for who needs more than one of them.
struct Elevation {
  Elevation() = default;
  Elevation(double angle)  // NOLINT(google-explicit-constructor): it is that angle
      : angle_rad(angle), sine(std::sin(angle)), cosine(std::cos(angle)) {}

  double tangent() const { return sine / cosine; }

  double angle_rad = 0.0;
  double sine = 0.0;
  double cosine = 1.0;
};

}  // namespace trivela::kicking
