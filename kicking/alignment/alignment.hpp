#pragma once

#include <Eigen/Core>

#include "kicking/ballistics/moving_kick.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/geometry/frames.hpp"
#include "kicking/optional_double.hpp"

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

/// How beta lengthens one side of the target's segment S2 (paper, section 3.4: "it calculates the length of the second
/// segment"). kMax: max(w, d tan beta), the 10 cm being "the minimum allowed intersection error". kAdd: w + d tan beta.
enum class Extension { kMax, kAdd };

/// Lengths of the two segments.
struct AlignmentRule {
  double half_width_m = 0.10;  ///< w, each side of S2 (paper, section 3.4)
  Extension extension = Extension::kMax;
  double reach_m = 30.0;                  ///< length of S1; beyond the field's diagonal
  double beta_limit_rad = radians(60.0);  ///< tan beta grows without bound; beyond this angle the extension stays
};

/// The alignment condition at one instant.
struct Alignment {
  bool aligned = false;
  double centre_distance_m = 0.0;  ///< robot centre to target
  OptionalDouble offset_right_m;   ///< where S1 meets the line of S2, right of the target; none: it does not, ahead
  double left_m = 0.0;             ///< reach of S2 to the left of the target
  double right_m = 0.0;
};

/// Is the robot aligned with the target (paper, sections 3.1 and 3.4)? S1 starts at the robot's centre along the
/// heading turned clockwise by alpha; S2 goes through the target, perpendicular to the line robot - target. Both in F.
/// In closed form, with t the unit vector to the target, n its right normal and u that of S1: c = u.t, q = u.n, s = d q
/// / c; aligned iff c > 0, d / c <= reach and -left <= s <= right. omega > 0 extends the right side by the rule, omega
/// < 0 the left; |beta| counts. A target closer than 1e-9 m or an input that is not finite is not aligned.
Alignment align(const Pose& robot, double alpha_rad, double beta_rad, double omega_radps,
                const Eigen::Vector2d& target_m, const AlignmentRule& rule = {});

}  // namespace trivela::kicking
