#pragma once

#include "kicking/ballistics/moving_kick.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/geometry/frames.hpp"

namespace trivela::kicking {

// Angles between where the robot points at the order and where the ball goes.
// Two consistent pairs: the paper's line with the paper's beta (robot-centre vx, rotation about the centre), or the
// ball-point alpha with the turn of the delay alone. The ball point's -omega r is in the second alpha already: never
// mix the pairs.

/// alpha by the paper's line (section 3.2, Table 1) [rad], right positive: slope * vx.
double alpha_paper_rad(double vx_mps, double slope_rad_per_mps);

/// alpha by the one-parameter model b = T vx of Table 1 [rad]: atan(vx T / d). T = 0.923810 s is least squares over
/// Table 1.
double alpha_atan_rad(double vx_mps, double distance_m, double time_s);

/// alpha at the release by velocity addition at the ball's point [rad], right positive:
/// atan2(k_x (vx - omega r), V_kick cos(theta) + k_y vy).
double alpha_physical_rad(double v_kick_mps, const Elevation& exit_angle, const Transfer& transfer, const Twist& twist,
                          double ball_offset_m);

/// beta by the paper's line (section 3.3, figure 10) [rad], with the sign of omega: slope * omega.
double beta_paper_rad(double omega_radps, double slope_s);

/// beta of a rotation about the robot's centre [rad]: omega tau + atan(omega r / V_h), V_h the ball's horizontal speed.
double beta_physical_rad(double omega_radps, double delay_s, double ball_offset_m, double v_h_mps);

}  // namespace trivela::kicking
