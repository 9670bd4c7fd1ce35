#pragma once

#include <optional>

#include "kicking/ballistics/crossing.hpp"

namespace trivela::kicking {

/// The paper's law of a moving robot (section 2.2) [m/s]: V_kick = V0 - u cos(theta), u = k v_front. Exact to first
/// order at 45 degrees and h = 0, not in general; with k about 0.7 it is good to a few centimetres up to 1 m/s.
double moving_kick_paper(double v0_mps, double u_mps, const Elevation& exit_angle);

/// Kick of a robot whose forward velocity adds u = k v_front [m/s] to the ball's horizontal speed V cos(theta), through
/// the point: V^2 c (d s - h c) + V u (d s - 2 h c) - (h u^2 + g d^2 / 2) = 0, the positive root. None if d <= 0, d
/// tan(theta) <= h or the robot alone is too fast for a point below the launch.
std::optional<double> moving_kick_exact(const FlightPoint& point, const Elevation& exit_angle, double u_mps,
                                        double gravity_mps2 = kGravity_mps2);

}  // namespace trivela::kicking
