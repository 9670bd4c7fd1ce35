#pragma once

#include "kicking/constants.hpp"

namespace trivela::kicking {

/// How a ball leaves the kicker.
struct LobExit {
  double angle_rad = 0.0;  ///< over the floor
  double speed_mps = 0.0;
  double t_flight_s = 0.0;  ///< until it is back at launch height
};

/// Exit of a lob from its apex height H and range D [m], both of the ball's centre relative to the launch (paper,
/// section 2.2): theta = atan(4 H / D), V0 = sqrt(D g / sin(2 theta)). Effective values: drag is absorbed.
/// Throws std::invalid_argument unless both are positive.
LobExit exit_from_lob(double apex_m, double range_m, double gravity_mps2 = kGravity_mps2);

}  // namespace trivela::kicking
