#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kicking/estimate.hpp"

namespace trivela::kicking::lob {

/// How the ball's centre is found in its cluster of returns. kMiddleOfLimits: the paper's, the middle of the two outer
/// returns, moved away from the scanner by one ball radius. kCircle: a circle of the ball's radius, least squares in
/// range.
enum class CentreMethod { kCircle, kMiddleOfLimits };

/// The ball's centre in one scan: x along the kick from the launch, z over the floor.
struct BallCentre {
  std::int64_t t_ns = 0;  ///< of the beam through the centre
  double x_m = 0.0;
  double z_m = 0.0;
  int returns = 0;
  double chord_ratio = 1.0;  ///< angle covered / angle that a ball in the scan plane covers
};

/// The paper's fit: parabola z(x) through the centres, H and D relative to the launch height, theta = atan(4 H / D), V0
/// = sqrt(D g / sin 2 theta). Effective values: drag is absorbed.
struct EffectiveFit {
  Estimate exit_angle_rad;
  Estimate exit_speed_mps;
  Estimate height_m;    ///< apex over the launch height
  Estimate distance_m;  ///< range, back at the launch height
  double residual_rms_m = 0.0;
};

/// Chi-square with one degree of freedom of which chance has more in one flight of a thousand.
inline constexpr double kMisfit = 10.828;

/// The robust fit in time, with drag: Huber least squares of the flight equation to centres and their beam times. Where
/// it misfits, the standard errors hold what a lift would move the values by.
struct TrueFit {
  Estimate exit_angle_rad;
  Estimate exit_speed_mps;
  Estimate drag_coefficient;  ///< se 0: it was given
  std::int64_t launch_t_ns = 0;
  double residual_rms_m = 0.0;
  double misfit_chi_square = 0.0;  ///< lack of fit: (C_L / its standard error)^2 of a flight with lift, too
  double lift_coefficient = 0.0;   ///< C_L; the centres leave it open where the misfit is small
  bool misfits() const { return misfit_chi_square > kMisfit; }
};

/// Why a flight is not taken for a lob.
enum class Refusal { kNone, kTooFewPoints, kOneSideOfApex, kPlaneMisaligned, kBadFit, kOperator };

/// "none", "too_few_points", "one_side_of_apex", "plane_misaligned", "bad_fit", "operator".
const char* name(Refusal refusal);

/// One flight seen by the scanner.
struct LobRecord {
  std::vector<BallCentre> centres;
  std::int64_t launch_t_ns = 0;  ///< of the true fit where there is one, else of the first centre
  Refusal refusal = Refusal::kNone;
  std::string why;  ///< one sentence with the numbers; empty when accepted
  std::optional<EffectiveFit> effective;
  std::optional<TrueFit> true_values;
  std::optional<double> power;  ///< set-point of the kick, where it is known
};

}  // namespace trivela::kicking::lob
