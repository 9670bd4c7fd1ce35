#include "kicking/geometry/frames.hpp"

namespace trivela::kicking {

Eigen::Vector2d rotate(const Eigen::Vector2d& vector, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * vector.x() - s * vector.y(), s * vector.x() + c * vector.y()};
}

Eigen::Vector2d direction(double heading_rad) { return {-std::sin(heading_rad), std::cos(heading_rad)}; }

Eigen::Vector2d to_field(const Pose& pose, const Eigen::Vector2d& point_in_robot_m) {
  return Eigen::Vector2d(pose.x_m, pose.y_m) + rotate(point_in_robot_m, pose.heading_rad);
}

Eigen::Vector2d to_robot(const Pose& pose, const Eigen::Vector2d& point_in_field_m) {
  return rotate(point_in_field_m - Eigen::Vector2d(pose.x_m, pose.y_m), -pose.heading_rad);
}

double bearing(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  const Eigen::Vector2d line = to_m - from_m;
  return std::atan2(-line.x(), line.y());
}

namespace {

/// sin(x) / x; below 0.05 by its series, whose next term is 1e-16 of it.
double sinc(double x) {
  if (std::abs(x) > 0.05) return std::sin(x) / x;
  const double square = x * x;
  return 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0));
}

}  // namespace

Pose advance(const Pose& pose, const Twist& twist, double dt_s) {
  const double half_turn = 0.5 * twist.omega_radps * dt_s;
  // The chord: its length is the arc times sin(h)/h, its direction is the twist turned by half the angle.
  const Eigen::Vector2d arc_m(twist.vx_mps * dt_s, twist.vy_mps * dt_s);
  const Eigen::Vector2d moved = sinc(half_turn) * rotate(arc_m, pose.heading_rad + half_turn);
  return {pose.x_m + moved.x(), pose.y_m + moved.y(), pose.heading_rad + 2.0 * half_turn};
}

}  // namespace trivela::kicking
