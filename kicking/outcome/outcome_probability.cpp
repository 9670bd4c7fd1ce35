#include "kicking/outcome/outcome_probability.hpp"

#include "kicking/outcome/p_inside.hpp"

namespace trivela::kicking {

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
