#include "kicking/outcome/outcome.hpp"

#include <cmath>

#include "kicking/outcome/p_inside.hpp"

namespace trivela::kicking {

Outcome classify(double x_cross_m, double z_cross_m, const Goal& goal, const Ball& ball) {
  if (!std::isfinite(x_cross_m) || !std::isfinite(z_cross_m)) return Outcome::kUnknown;
  const double side = std::abs(x_cross_m);
  if (side >= goal.wide_half_width_m(ball)) return x_cross_m < 0.0 ? Outcome::kWideLeft : Outcome::kWideRight;
  if (z_cross_m >= goal.over_height_m(ball)) return Outcome::kOver;
  if (side >= goal.clean_half_width_m(ball)) return Outcome::kPost;
  if (z_cross_m >= goal.clean_height_m(ball)) return Outcome::kBar;
  return Outcome::kOnTarget;
}

OutcomeProbabilities crossing_probabilities(double x_cross_m, double sd_x_m, double z_cross_m, double sd_z_m,
                                            const Goal& goal, const Ball& ball) {
  const auto left_of = [&](double x_m) { return normal_below(x_m - x_cross_m, sd_x_m); };
  const auto below = [&](double z_m) { return normal_below(z_m - z_cross_m, sd_z_m); };
  const double left = left_of(-goal.wide_half_width_m(ball));
  const double right = 1.0 - left_of(goal.wide_half_width_m(ball));
  const double side = goal.clean_half_width_m(ball);
  const double clean = left_of(side) - left_of(-side);
  const double within = 1.0 - left - right;
  const double under = below(goal.over_height_m(ball)), under_bar = below(goal.clean_height_m(ball));
  OutcomeProbabilities p{};
  const auto of = [&](Outcome outcome) -> double& { return p[static_cast<std::size_t>(outcome)]; };
  of(Outcome::kWideLeft) = left;
  of(Outcome::kWideRight) = right;
  of(Outcome::kOver) = within * (1.0 - under);
  of(Outcome::kPost) = (within - clean) * under;
  of(Outcome::kBar) = clean * (under - under_bar);
  of(Outcome::kOnTarget) = clean * under_bar;
  return p;
}

}  // namespace trivela::kicking
