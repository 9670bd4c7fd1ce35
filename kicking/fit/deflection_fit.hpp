#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kicking/fit/least_squares.hpp"

namespace trivela::kicking {

/// One kick of a robot that moves sideways (paper, section 3.2, Table 1).
struct DeflectionRow {
  double vx_mps = 0.0;                 ///< of the robot's centre, to its right
  double distance_m = 0.0;             ///< ball to goal line, at the order
  double b_m = 0.0;                    ///< where the ball crosses, right of where the robot pointed at the order
  double lever_m = 0.0;                ///< robot's centre to ball: alpha is seen from the centre, where S1 begins
  std::optional<double> v_h_mps = {};  ///< V cos(theta) + k_y vy: horizontal speed of the ball along the pointing line
};

/// Both models of alpha(vx) over the same kicks.
struct DeflectionFit {
  std::vector<double> alpha_rad;  ///< atan(b / (d + lever)), measured

  /// The paper's line alpha = slope vx. Slope in rad per m/s, residuals in rad.
  OriginLine line;

  /// Physical model with one parameter, b = T vx: slope T [s], residuals in m. T = k_x d / V_h + tau at one distance.
  OriginLine travel;
  std::vector<double> travel_residual_rad;  ///< alpha - atan(T vx / (d + lever))
  double travel_rms_rad = 0.0;

  /// k_x of b = k_x vx d / V_h + vx tau, residuals in m; where the delay and every row's V_h are known. A constant of
  /// the drag-free law: drag takes from the sideways speed as well, so that a full transfer comes out as about 0.94 at
  /// 6 m.
  std::optional<OriginLine> lateral;
};

/// Least squares over the kicks (Figure 8). `delay_s`: order to release.
/// Throws std::invalid_argument for fewer than two kicks, vx all zero, a distance that is not above zero, or a value
/// that is not finite.
DeflectionFit fit_deflection(std::span<const DeflectionRow> rows, std::optional<double> delay_s = std::nullopt);

/// One turning speed and the allowed error with which the ball hits the centre of the target (paper, section 3.3).
struct RotationRow {
  double omega_radps = 0.0;            ///< counter-clockwise
  double allowed_error_m = 0.0;        ///< b, positive where the paper extends: right for omega > 0, left for omega < 0
  double distance_m = 8.0;             ///< robot's centre to target (paper: 8 m)
  std::optional<double> v_h_mps = {};  ///< horizontal speed of the ball
};

/// What a rotation's b contains beside the delay.
struct RotationLever {
  double ball_offset_m = 0.27;  ///< r, robot's centre to ball
  double cycle_s = 0.0;         ///< control cycle: the order goes out half a cycle late on average, which b absorbs
};

/// beta(omega) over the rows, with the sign of omega.
struct RotationFit {
  std::vector<double> beta_rad;  ///< sign(omega) atan(b / d), measured
  OriginLine line;               ///< the paper's beta = slope omega: slope in s, residuals in rad

  /// Delay tau of beta = omega (tau + cycle / 2) + atan(omega r / V_h): slope in s, residuals in rad. Where the lever
  /// and every row's V_h are known.
  std::optional<OriginLine> delay;
};

/// Least squares over the rows (Figures 9 and 10).
/// Throws std::invalid_argument for fewer than two rows, omega all zero, a distance or V_h that is not above zero, or
/// a value that is not finite.
RotationFit fit_rotation(std::span<const RotationRow> rows, std::optional<RotationLever> lever = std::nullopt);

}  // namespace trivela::kicking
