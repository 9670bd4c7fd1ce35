#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kicking/fit/least_squares.hpp"

namespace trivela::kicking {

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
