#pragma once

#include <array>
#include <cstddef>

#include "kicking/optional_double.hpp"
#include "kicking/policy/predictive/learned_decision.hpp"

namespace trivela::kicking {

/// What a kick looks like when it is ordered, as the robot believes it.
struct ShotFeatures {
  double p_on_target = 0.5;            ///< physical prediction of the predictive policy
  double distance_m = 0.0;             ///< ball centre to target, horizontal
  double vx_mps = 0.0;                 ///< of the robot, right positive
  double vy_mps = 0.0;                 ///< forward
  double omega_radps = 0.0;            ///< counter-clockwise
  double power = 0.0;                  ///< set-point
  OptionalDouble opponent_distance_m;  ///< nearest opponent to the ball; none: not seen
};

/// A logistic correction of the physical probability P of a ball on target, trained on logs (`trivela learn`):
///
///     logit p = logit P + b + sum_i w_i (x_i - mean_i) / scale_i
///
/// With b = 0 and w = 0 it is P itself. Left and right count alike: the features have |v_x|, |omega| and v_x omega.
/// P is held within [1e-4, 1 - 1e-4]. Nothing allocates.
struct LearnedModel {
  /// In the order of the arrays and of the file: logit_p, distance_m, distance_squared_m2, speed_x_mps, vy_mps,
  /// turn_radps, vx_omega, power, opponent_distance_m.
  static constexpr std::array<const char*, 9> kFeatureNames{"logit_p",     "distance_m", "distance_squared_m2",
                                                            "speed_x_mps", "vy_mps",     "turn_radps",
                                                            "vx_omega",    "power",      "opponent_distance_m"};
  static constexpr std::size_t kFeatures = kFeatureNames.size();
  using Row = std::array<double, kFeatures>;

  double intercept = 0.0;
  Row weights{};
  Row means{};
  Row scales{1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};

  LearnedDecision decision{};  ///< beside that correction

  /// Whether it changes P.
  bool corrects() const { return intercept != 0.0 || weights != Row{}; }

  /// x of a kick; an opponent not seen is as far as the farthest that counts, 6 m.
  static Row row_of(const ShotFeatures& shot);

  /// Probability of a ball on target, in (0, 1); NaN where a feature is not finite.
  double p_on_target(const ShotFeatures& shot) const;
};

/// ln(p / (1 - p)) with p held within [1e-4, 1 - 1e-4].
double held_logit(double p);

}  // namespace trivela::kicking
