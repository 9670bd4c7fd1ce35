#pragma once

#include <numbers>

namespace trivela::kicking {

/// Gravity [m/s2]. The value of every test vector; the released CAMBADA code has 9.8067.
inline constexpr double kGravity_mps2 = 9.81;

/// FIFA size 5 ball: 0.43 +- 0.02 kg, circumference 0.69 +- 0.01 m; the radius is the paper's (section 2.1: 11 cm).
struct Ball {
  double mass_kg = 0.43;
  double radius_m = 0.11;
};

/// Air around the ball: density at 20 C near sea level; C_d = 0.25 fits Hawk-Eye tracks of football flights at 7 to 10
/// m/s. Not measured for Middle Size League balls; 0.15 to 0.5 is plausible.
struct Air {
  double density_kgpm3 = 1.2;
  double drag_coefficient = 0.25;
};

/// k of the quadratic drag a = -k |v| v [1/m]: k = rho C_d pi r^2 / (2 m).
constexpr double drag_per_m(const Ball& ball, const Air& air) {
  return air.density_kgpm3 * air.drag_coefficient * std::numbers::pi * ball.radius_m * ball.radius_m /
         (2.0 * ball.mass_kg);
}

}  // namespace trivela::kicking
