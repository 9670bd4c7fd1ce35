#include "kicking/outcome/crossing_spread.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kicking/outcome/outcome.hpp"

namespace trivela::kicking {
namespace {

/// Adds up what independent errors do to the crossing.
struct Sum {
  double t_s, slope, descent;  // T, W_x / W_y, (g T - v_z) / W_y
  double var_x_m2 = 0.0;
  double var_z_m2 = 0.0;

  /// An error of one standard deviation: ball moved by `shift_m` at the line, upward speed changed by `dvz_mps`.
  void add(const Eigen::Vector2d& shift_m, double dvz_mps = 0.0) {
    const double dx = shift_m.x() - slope * shift_m.y();
    const double dz = t_s * dvz_mps + descent * shift_m.y();
    var_x_m2 += dx * dx;
    var_z_m2 += dz * dz;
  }
};

}  // namespace

CrossingSpread crossing_spread(const ReleaseState& release, const KickExit& kick, const RobotModel& robot,
                               const StateSpread& state, double goal_y_m, double gravity_mps2) {
  const double c = kick.exit_angle.cosine, s = kick.exit_angle.sine;
  const double r = robot.ball_offset_m, v = kick.v_kick_mps;
  const Eigen::Vector2d f = release.forward, right = release.right();
  const Eigen::Vector2d carried = release.carried_mps(robot.transfer_exact, r);
  const Eigen::Vector2d w = v * c * f + carried;
  const double t = (goal_y_m - release.ball_m.y()) / w.y();
  CrossingSpread out;
  if (!(t >= 0.0 && std::isfinite(t))) {
    out.x_m = out.z_m = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  out.t_flight_s = t;
  out.x_m = release.ball_m.x() + w.x() * t;
  out.z_m = robot.ball.radius_m + v * s * t - 0.5 * gravity_mps2 * t * t;

  const KickSpreads& spread = robot.spreads;
  const Transfer& k = robot.transfer_exact;
  const double tau = robot.delay_s;
  Sum sum{t, w.x() / w.y(), (gravity_mps2 * t - v * s) / w.y()};
  const double speed_var =
      spread.speed_sd_ratio * spread.speed_sd_ratio + spread.table_sd_ratio * spread.table_sd_ratio;
  const double dv = v * std::sqrt(speed_var);
  sum.add(t * c * dv * f, s * dv);
  sum.add(-t * v * s * spread.exit_angle_sd_rad * f, v * c * spread.exit_angle_sd_rad);
  sum.add(t * v * c * spread.direction_sd_rad * right);
  const Eigen::Vector2d turned = -v * c * release.omega_radps * right;  // dW by the turn of a second
  sum.add(spread.delay_sd_s * (release.ball_point_mps(r) + t * turned));
  sum.add(t * spread.transfer_sd_ratio * carried.dot(right) * right);
  sum.add(t * spread.transfer_sd_ratio * carried.dot(f) * f);
  sum.add({state.position_m, 0.0});
  sum.add({0.0, state.position_m});
  // Left of a vector is its derivative by the heading.
  sum.add(state.heading_rad * (-r * right + t * Eigen::Vector2d(-w.y(), w.x())));
  sum.add((tau + t * k.lateral) * state.speed_mps * right);
  sum.add((tau + t * k.along_mps(1.0)) * state.speed_mps * f);
  sum.add(state.turn_rate_radps * (-(r * tau + t * (k.lateral * r + tau * v * c))) * right);
  out.sd_x_m = std::sqrt(sum.var_x_m2);
  out.sd_z_m = std::sqrt(sum.var_z_m2);
  return out;
}

double p_on_target(const CrossingSpread& crossing, double bounce_ratio, const Goal& goal, const Ball& ball,
                   double least) {
  const double side = goal.clean_half_width_m(ball);
  const double between =
      normal_below(side - crossing.x_m, crossing.sd_x_m) - normal_below(-side - crossing.x_m, crossing.sd_x_m);
  if (between <= least) return 0.0;
  const double below = normal_below(goal.clean_height_m(ball) - crossing.z_m, crossing.sd_z_m);
  const double floor = normal_below(ball.radius_m - crossing.z_m, crossing.sd_z_m);
  return std::max(0.0, between * (below - (1.0 - bounce_ratio) * floor));
}

BestHeight::BestHeight(double bounce_ratio, const Goal& goal, const Ball& ball)
    : least_m_(ball.radius_m),
      middle_m_(0.5 * (goal.clean_height_m(ball) + ball.radius_m)),
      lower_per_m_(-std::log1p(-bounce_ratio) / (goal.clean_height_m(ball) - ball.radius_m)) {}

double BestHeight::operator()(double sd_z_m) const {
  return std::max(least_m_, middle_m_ - sd_z_m * sd_z_m * lower_per_m_);
}

}  // namespace trivela::kicking
