#include "evaluator/drift/drift_watch.hpp"

#include <Eigen/Core>
#include <cmath>

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

}  // namespace trivela::evaluator
