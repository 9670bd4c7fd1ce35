#include "sim/robot_body.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::sim {

void RobotBody::place(const kicking::Pose& pose, const kicking::Twist& twist) {
  pose_ = pose;
  const double c = std::cos(pose.heading_rad), s = std::sin(pose.heading_rad);
  vx_field_mps_ = c * twist.vx_mps - s * twist.vy_mps;
  vy_field_mps_ = s * twist.vx_mps + c * twist.vy_mps;
  omega_radps_ = twist.omega_radps;
  follow(twist);
}

void RobotBody::follow(const kicking::Twist& set_point) {
  if (!std::isfinite(set_point.vx_mps) || !std::isfinite(set_point.vy_mps) || !std::isfinite(set_point.omega_radps)) {
    set_point_ = {};
    return;
  }
  const double speed = std::hypot(set_point.vx_mps, set_point.vy_mps);
  const double scale = speed > limits_.max_speed_mps ? limits_.max_speed_mps / speed : 1.0;
  set_point_ = {set_point.vx_mps * scale, set_point.vy_mps * scale,
                std::clamp(set_point.omega_radps, -limits_.max_turn_rate_radps, limits_.max_turn_rate_radps)};
}

void RobotBody::advance(double dt_s) {
  const double c = std::cos(pose_.heading_rad), s = std::sin(pose_.heading_rad);
  double ax = c * set_point_.vx_mps - s * set_point_.vy_mps - vx_field_mps_;
  double ay = s * set_point_.vx_mps + c * set_point_.vy_mps - vy_field_mps_;
  const double change = std::hypot(ax, ay);
  const double allowed = limits_.max_acceleration_mps2 * dt_s;
  if (change > allowed) {
    ax *= allowed / change;
    ay *= allowed / change;
  }
  const double turn_allowed = limits_.max_turn_acceleration_radps2 * dt_s;
  const double turn = std::clamp(set_point_.omega_radps - omega_radps_, -turn_allowed, turn_allowed);
  pose_.x_m += (vx_field_mps_ + 0.5 * ax) * dt_s;
  pose_.y_m += (vy_field_mps_ + 0.5 * ay) * dt_s;
  pose_.heading_rad = kicking::wrap_angle(pose_.heading_rad + (omega_radps_ + 0.5 * turn) * dt_s);
  vx_field_mps_ += ax;
  vy_field_mps_ += ay;
  omega_radps_ += turn;
}

kicking::Twist RobotBody::twist() const {
  const double c = std::cos(pose_.heading_rad), s = std::sin(pose_.heading_rad);
  return {c * vx_field_mps_ + s * vy_field_mps_, -s * vx_field_mps_ + c * vy_field_mps_, omega_radps_};
}

Vec3 RobotBody::ball_point_m() const {
  return {pose_.x_m - std::sin(pose_.heading_rad) * limits_.ball_offset_m,
          pose_.y_m + std::cos(pose_.heading_rad) * limits_.ball_offset_m, 0.0};
}

}  // namespace trivela::sim
