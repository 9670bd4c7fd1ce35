#pragma once

#include <cmath>
#include <optional>

#include "kicking/ballistics/crossing.hpp"

namespace trivela::kicking {

/// Velocity [m/s] that the robot gives to the ball at its point, seen along the line ball - target.
struct Carry {
  double along_mps = 0.0;
  double right_mps = 0.0;
};

/// Kick that makes up for the carry in speed and direction at once.
struct Aim {
  double v_kick_mps = 0.0;
  double t_flight_s = 0.0;
  double left_mps = 0.0;    ///< of the kick's own velocity: away from the line, against the carry
  double toward_mps = 0.0;  ///< and along it, > 0
};

/// Joint solution of direction and height, without drag, with T the time of flight and delta the angle to the left:
/// V c sin(delta) = w_right, V c cos(delta) + w_along = d / T, V s T - g T^2 / 2 = h. Eliminating V and delta,
/// (h + g T^2 / 2) cot(theta) = |(d - w_along T, w_right T)|, solved for T in a bracket.
/// None if the point is out of the angle's reach or the kicker would have to point backwards.
std::optional<Aim> aim_exact(const FlightPoint& point, const Elevation& exit_angle, const Carry& carry,
                             double gravity_mps2 = kGravity_mps2);

}  // namespace trivela::kicking
