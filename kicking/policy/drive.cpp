#include "kicking/policy/drive.hpp"

#include <algorithm>

namespace trivela::kicking {

double turn_rate_for(double heading_error_rad, double gain_hz, const PolicyConfig& config, double braking) {
  const double error = std::abs(heading_error_rad);
  const double curve = std::sqrt(2.0 * braking * config.max_turn_acceleration_radps2 * error);
  return std::copysign(std::min({gain_hz * error, curve, config.max_turn_rate_radps}), heading_error_rad);
}

Eigen::Vector2d dribble_towards(const Pose& robot, const Eigen::Vector2d& point_m, const PolicyConfig& config,
                                double dribble_mps) {
  return dribble_towards(to_robot(robot, point_m), config, dribble_mps);
}

Eigen::Vector2d dribble_towards(const Eigen::Vector2d& ahead_m, const PolicyConfig& config, double dribble_mps) {
  const double distance = ahead_m.norm();
  const double room = distance - config.keep_off_m;
  if (!(room > 0.0)) return {0.0, 0.0};
  const double speed = std::min(dribble_mps, std::sqrt(2.0 * config.max_brake_mps2 * room));
  const Eigen::Vector2d velocity = speed / distance * ahead_m;
  return {std::clamp(velocity.x(), -config.max_sideways_mps, config.max_sideways_mps),
          std::clamp(velocity.y(), -config.max_sideways_mps, config.max_forward_mps)};
}

}  // namespace trivela::kicking
