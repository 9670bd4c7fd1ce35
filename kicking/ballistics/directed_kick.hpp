#pragma once

#include <optional>

#include "kicking/constants.hpp"
#include "kicking/geometry/elevation.hpp"

namespace trivela::kicking {

/// The way to a line in front: its distance D straight ahead, the share of the kick's direction that points there (cos
/// of the angle between them), and what the robot's motion adds towards it.
struct LineAhead {
  double distance_m = 0.0;
  double toward_ratio = 1.0;
  double carried_mps = 0.0;
};

struct DirectedKick {
  double v_kick_mps = 0.0;
  double t_flight_s = 0.0;
};

/// Exit speed of a kick whose direction is given, so that the ball crosses the line at height h over the launch,
/// without drag. With a = toward_ratio, T the time of flight and V the speed: V c a + u = D / T and V s T - g T^2 / 2 =
/// h. Eliminating V, g T^2 / 2 + (tan(theta) u / a) T - (tan(theta) D / a - h) = 0, the positive root. None if the kick
/// points away from the line (a <= 0), the height is above its straight line or the speed would not be positive.
std::optional<DirectedKick> directed_kick(const LineAhead& line, double height_m, const Elevation& exit_angle,
                                          double gravity_mps2 = kGravity_mps2);

}  // namespace trivela::kicking
