#include "kicking/alignment/release_predictor.hpp"

#include <cmath>

namespace trivela::kicking {

std::optional<PredictedCrossing> predict_crossing(const Pose& pose, const Twist& twist, const KickAction& kick,
                                                  double goal_y_m, double launch_height_m, double gravity_mps2) {
  return crossing_of_release(TurnedPose{advance(pose, twist, kick.delay_s)}, twist, kick, goal_y_m, launch_height_m,
                             gravity_mps2);
}

std::optional<PredictedCrossing> crossing_of_release(const TurnedPose& release, const Twist& twist,
                                                     const KickAction& kick, double goal_y_m, double launch_height_m,
                                                     double gravity_mps2) {
  const Eigen::Vector2d forward = release.forward(), right = release.right();
  const Eigen::Vector2d ball = Eigen::Vector2d(release.x_m, release.y_m) + kick.ball_offset_m * forward;
  const Eigen::Vector2d velocity =
      kick.transfer.lateral * (twist.vx_mps - twist.omega_radps * kick.ball_offset_m) * right +
      (kick.v_kick_mps * kick.exit_angle.cosine + kick.transfer.along_mps(twist.vy_mps)) * forward;
  const double t = (goal_y_m - ball.y()) / velocity.y();
  if (!(t >= 0.0 && std::isfinite(t))) return std::nullopt;
  const double v_z = kick.v_kick_mps * kick.exit_angle.sine;
  return PredictedCrossing{.x_m = ball.x() + velocity.x() * t,
                           .z_m = launch_height_m + v_z * t - 0.5 * gravity_mps2 * t * t,
                           .t_flight_s = t,
                           .release_m = ball,
                           .release_heading_rad = release.heading_rad};
}

}  // namespace trivela::kicking
