#pragma once

#include "kicking/constants.hpp"

namespace trivela::kicking {

/// How a floor slows a ball.
struct Floor {
  double friction_ratio = 0.3;             ///< sliding, of the weight; assumed, 0.2 to 0.6 is plausible
  double restitution_ratio = 0.65;         ///< vertical speed kept in a bounce; assumed, as in the simulator
  double rolling_deceleration_mps2 = 0.5;  ///< assumed, as in the simulator
};

/// Part of its speed over ground that a thin-walled ball without spin has when it rolls: its angular momentum about
/// the point of contact stays, v = V / (1 + 2/3) = 3 V / 5, however the floor got it there (R. Cross, Grip-slip
/// behavior of a bouncing ball, Am. J. Phys. 70, 1093, 2002).
inline constexpr double kRollingShare = 0.6;

/// Time in which a ball that leaves the floor without spin, at v_h over ground and v_z upwards [m/s], has gone
/// `distance_m` over ground [s]; infinite where it stops before. Without drag:
///
///     flies     until t = 2 v_z / g
///     touches   v = v_h - min(friction (1 + restitution) v_z, 2 v_h / 5)
///     slides    with the deceleration friction g, later bounces included, until v = 3 v_h / 5
///     rolls     with rolling_deceleration
double floor_time_s(double v_h_mps, double v_z_mps, double distance_m, const Floor& floor = {},
                    double gravity_mps2 = kGravity_mps2);

}  // namespace trivela::kicking
