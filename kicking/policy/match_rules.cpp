#include "kicking/policy/match_rules.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::kicking {

Twist DribbleLimit::kept(const Twist& command, const Eigen::Vector2d& centre_m, const Eigen::Vector2d& forward) const {
  const Eigen::Vector2d way = centre_m - taken_m_;
  const double carried_m = way.norm();
  if (!(carried_m > 0.0)) return command;
  const Eigen::Vector2d outward = way / carried_m;
  const Eigen::Vector2d right(forward.y(), -forward.x());
  const Eigen::Vector2d velocity = command.vx_mps * right + command.vy_mps * forward;
  const double allowed_mps = std::sqrt(2.0 * brake_mps2_ * std::max(0.0, radius_m_ - carried_m));
  const double excess_mps = velocity.dot(outward) - allowed_mps;
  if (!(excess_mps > 0.0)) return command;
  const Eigen::Vector2d kept = velocity - excess_mps * outward;
  return {kept.dot(right), kept.dot(forward), command.omega_radps};
}

}  // namespace trivela::kicking
