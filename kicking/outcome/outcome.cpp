#include "kicking/outcome/outcome.hpp"

#include <numbers>

namespace trivela::kicking {
namespace {

constexpr double kCertain = 6.5;  // standard deviations: 4e-11 beyond them

}  // namespace

double normal_below(double margin_m, double sd_m) {
  if (!(sd_m > 0.0)) return margin_m > 0.0 ? 1.0 : 0.0;
  const double sds = margin_m / sd_m;
  if (std::abs(sds) > kCertain) return sds > 0.0 ? 1.0 : 0.0;
  return 0.5 * std::erfc(-sds / std::numbers::sqrt2);
}

HeightSensitivity height_sensitivity(const KickAtLine& kick, double gravity_mps2) {
  const double d = kick.distance_m;
  const double v = kick.v_kick_mps;
  const double c = std::cos(kick.exit_angle_rad);
  const double s = std::sin(kick.exit_angle_rad);
  const double v_x = v * c + kick.u_mps;
  const double v_z = v * s;
  const double t = d / v_x;
  const double dz_dvx = (-v_z + gravity_mps2 * t) * t / v_x;  // the chain rule's common factor
  return {kick.launch_height_m + v_z * t - 0.5 * gravity_mps2 * t * t, s * t + c * dz_dvx, v * c * t - v_z * dz_dvx,
          dz_dvx};
}

InsideProbability p_inside(const KickAtLine& kick, const KickSpread& spread, double x_mean_m, const Goal& goal,
                           const Ball& ball, double gravity_mps2) {
  const HeightSensitivity height = height_sensitivity(kick, gravity_mps2);
  const double by_speed = height.dz_dv_s * spread.speed_relative * kick.v_kick_mps;
  const double by_angle = height.dz_dtheta_m_per_rad * spread.exit_angle_rad;
  const double by_robot = height.dz_du_s * spread.u_mps;
  const double sd_z = std::sqrt(by_speed * by_speed + by_angle * by_angle + by_robot * by_robot);
  const double p_below_bar = normal_below(goal.clean_height_m(ball) - height.z_m, sd_z);
  const double clean = goal.clean_half_width_m(ball);
  const double p_between_posts =
      normal_below(clean - x_mean_m, spread.lateral_m) - normal_below(-clean - x_mean_m, spread.lateral_m);
  return {height.z_m, sd_z, p_below_bar, p_between_posts, p_below_bar * p_between_posts};
}

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
