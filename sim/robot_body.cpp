#include "sim/robot_body.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::sim {

void RobotBody::place(const kicking::Pose& pose, const kicking::Twist& twist) {
  pose_ = pose;
  axis_ = {std::cos(pose.heading_rad), std::sin(pose.heading_rad)};
  const auto [c, s] = axis_;
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
  const double speed = std::sqrt(set_point.vx_mps * set_point.vx_mps + set_point.vy_mps * set_point.vy_mps);
  const double scale = speed > limits_.max_speed_mps ? limits_.max_speed_mps / speed : 1.0;
  set_point_ = {set_point.vx_mps * scale, set_point.vy_mps * scale,
                std::clamp(set_point.omega_radps, -limits_.max_turn_rate_radps, limits_.max_turn_rate_radps)};
}

void RobotBody::advance(double dt_s) {
  // The set-point is of R, so that in F it turns with the robot: from (from_x, from_y) to (to_x, to_y).
  const double from_x = axis_.c * set_point_.vx_mps - axis_.s * set_point_.vy_mps;
  const double from_y = axis_.s * set_point_.vx_mps + axis_.c * set_point_.vy_mps;
  turn(dt_s);
  const double to_x = axis_.c * set_point_.vx_mps - axis_.s * set_point_.vy_mps;
  const double to_y = axis_.s * set_point_.vx_mps + axis_.c * set_point_.vy_mps;

  const double allowed = limits_.max_acceleration_mps2 * dt_s;
  double ax = to_x - vx_field_mps_, ay = to_y - vy_field_mps_;  // change of velocity
  const double square = ax * ax + ay * ay;
  if (square <= allowed * allowed) {
    // First up to the set-point as fast as it goes, then with it as it turns.
    const double jump_x = from_x - vx_field_mps_, jump_y = from_y - vy_field_mps_;
    const double jump = std::sqrt(jump_x * jump_x + jump_y * jump_y);
    const double early = 0.5 * std::max(0.0, dt_s - jump / limits_.max_acceleration_mps2);
    pose_.x_m += (vx_field_mps_ + 0.5 * ax) * dt_s + jump_x * early;
    pose_.y_m += (vy_field_mps_ + 0.5 * ay) * dt_s + jump_y * early;
  } else {
    const double mid_x = 0.5 * (from_x + to_x) - vx_field_mps_, mid_y = 0.5 * (from_y + to_y) - vy_field_mps_;
    const double way = std::sqrt(mid_x * mid_x + mid_y * mid_y);
    ax = way > 0.0 ? allowed * mid_x / way : 0.0;
    ay = way > 0.0 ? allowed * mid_y / way : 0.0;
    pose_.x_m += (vx_field_mps_ + 0.5 * ax) * dt_s;
    pose_.y_m += (vy_field_mps_ + 0.5 * ay) * dt_s;
  }
  vx_field_mps_ += ax;
  vy_field_mps_ += ay;
}

void RobotBody::turn(double dt_s) {
  const double gap = set_point_.omega_radps - omega_radps_;
  if (gap == 0.0 && omega_radps_ == 0.0) return;
  const double ramp_s = std::min(dt_s, std::abs(gap) / limits_.max_turn_acceleration_radps2);
  const double change = std::copysign(limits_.max_turn_acceleration_radps2 * ramp_s, gap);
  pose_.heading_rad = kicking::wrap_angle(pose_.heading_rad + omega_radps_ * dt_s + change * (dt_s - 0.5 * ramp_s));
  omega_radps_ = ramp_s < dt_s ? set_point_.omega_radps : omega_radps_ + change;
  axis_ = {std::cos(pose_.heading_rad), std::sin(pose_.heading_rad)};
}

kicking::Twist RobotBody::twist() const {
  const auto [c, s] = axis_;
  return {c * vx_field_mps_ + s * vy_field_mps_, -s * vx_field_mps_ + c * vy_field_mps_, omega_radps_};
}

Eigen::Vector3d RobotBody::ball_point_m() const {
  return {pose_.x_m - axis_.s * limits_.ball_offset_m, pose_.y_m + axis_.c * limits_.ball_offset_m, 0.0};
}

}  // namespace trivela::sim
