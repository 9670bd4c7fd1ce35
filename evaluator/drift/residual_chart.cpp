#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "evaluator/drift/drift_watch.hpp"
#include "kicking/constants.hpp"
#include "kicking/model/robot_model.hpp"

namespace trivela::evaluator {

KickResidual residual_of(const WatchedKick& kick) {
  constexpr double kShortestFlight_s = 0.05, kLeastLever_m = 0.1;
  const double t_s = kick.t_flight_s, launch_m = kicking::Ball{}.radius_m, g = kicking::kGravity_mps2;
  KickResidual residual;
  residual.group = kick.policy;
  if (!kick.seen_to_the_line || !(t_s > kShortestFlight_s)) return residual;
  const kicking::Pose release = kicking::advance(kick.robot, kick.twist, kick.lead_s);
  const Eigen::Vector2d arm = kicking::RobotModel{}.ball_offset_m * kicking::direction(release.heading_rad);
  const Eigen::Vector2d from = Eigen::Vector2d(release.x_m, release.y_m) + arm;
  const Eigen::Vector2d e = (Eigen::Vector2d(kick.x_m, kick.goal_y_m) - from) / t_s;
  const double v_z = (kick.z_m - launch_m) / t_s + 0.5 * g * t_s;
  const Eigen::Vector2d carried = kicking::rotate({kick.twist.vx_mps, kick.twist.vy_mps}, release.heading_rad) +
                                  kick.twist.omega_radps * Eigen::Vector2d(-arm.y(), arm.x());
  const Eigen::Vector2d k = e - carried;
  const double q = k.dot(e) / e.squaredNorm();
  const double square = e.squaredNorm() + v_z * v_z;
  const double speed_lever = (k.dot(e) + v_z * v_z) / square;
  residual.metres = v_z * t_s * (1.0 - q) + g * t_s * t_s * q;
  if (!(residual.metres > kLeastLever_m) || !(speed_lever > kLeastLever_m)) return {};
  if (kick.bounced) {
    residual.height = (launch_m - kick.z_m) / residual.metres;
    residual.height_at_most = true;
  } else if (kick.z_cross_m) {
    residual.height = (*kick.z_cross_m - kick.z_m) / residual.metres;
  }
  if (kick.exit_speed_mps && *kick.exit_speed_mps > 0.0)
    residual.speed = std::log(*kick.exit_speed_mps / std::sqrt(square)) / speed_lever;
  return residual;
}

namespace {

constexpr double kFar = -8.0;  // standard deviations, from where on Phi is taken by its tail

double log_below(double c) {
  if (c < kFar) return -0.5 * c * c - std::log(-c * std::sqrt(2.0 * std::numbers::pi));
  return std::log(0.5 * std::erfc(-c / std::numbers::sqrt2));
}

}  // namespace

double mean_below(double c) {
  if (c < kFar) return c;
  return -std::exp(-0.5 * c * c) / std::sqrt(2.0 * std::numbers::pi) / (0.5 * std::erfc(-c / std::numbers::sqrt2));
}

double FactorChart::sd() const {
  return std::sqrt((rule_.expected_weight * rule_.expected_sd * rule_.expected_sd + squares_) /
                   (rule_.expected_weight + static_cast<double>(known_)));
}

void FactorChart::judge(const Group& group, double x, bool at_most) {
  const double sd = this->sd() * std::sqrt(1.0 + 1.0 / static_cast<double>(group.count));  // nor is the mean known
  const double c = (x - group.mean) / sd, d = rule_.shift / sd;
  const double z = std::clamp(c, -rule_.clip, rule_.clip);
  if (at_most) {
    const double as_before = log_below(z);
    up_ = std::max(0.0, up_ + log_below(z - d) - as_before);
    down_ = std::max(0.0, down_ + log_below(z + d) - as_before);
  } else {
    up_ = std::max(0.0, up_ + d * (z - 0.5 * d));
    down_ = std::max(0.0, down_ + d * (-z - 0.5 * d));
  }
}

bool FactorChart::add(double x, bool at_most, int group_id) {
  Group& group = groups_[group_id];
  if (at_most && group.count == 0) return false;  // says nothing of a mean that nobody knows
  if (group.count >= static_cast<std::size_t>(rule_.quiet)) judge(group, x, at_most);
  const double sd = this->sd();
  if (at_most) {
    const double c = (x - group.mean) / sd, m = mean_below(c);
    x = group.mean + sd * m;
    squares_ += std::max(0.0, 1.0 + c * m - m * m) * sd * sd;
  }
  if (group.count++ > 0) ++known_;
  const double off = x - group.mean;
  group.mean += off / static_cast<double>(group.count);
  squares_ += off * (x - group.mean);
  return up_ > rule_.limit || down_ > rule_.limit;
}

}  // namespace trivela::evaluator
