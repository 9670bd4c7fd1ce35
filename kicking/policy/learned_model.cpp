#include "kicking/policy/learned_model.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/outcome/outcome.hpp"

namespace trivela::kicking {
namespace {

constexpr double kLeastP = 1e-4;
constexpr double kFarthestOpponent_m = 6.0;  // farther ones disturb nobody

}  // namespace

double held_logit(double p) {
  const double held = std::clamp(p, kLeastP, 1.0 - kLeastP);
  return std::log(held / (1.0 - held));
}

LearnedModel::Row LearnedModel::row_of(const ShotFeatures& shot) {
  const double opponent_m = shot.opponent_distance_m.value_or(kFarthestOpponent_m);
  return {held_logit(shot.p_on_target),   shot.distance_m, shot.distance_m * shot.distance_m,
          std::abs(shot.vx_mps),          shot.vy_mps,     std::abs(shot.omega_radps),
          shot.vx_mps * shot.omega_radps, shot.power,      std::min(opponent_m, kFarthestOpponent_m)};
}

double LearnedModel::p_on_target(const ShotFeatures& shot) const {
  const Row row = row_of(shot);
  double x = row[0] + intercept;
  for (std::size_t i = 0; i < kFeatures; ++i) x += weights[i] * (row[i] - means[i]) / scales[i];
  return logistic(x);
}

}  // namespace trivela::kicking
