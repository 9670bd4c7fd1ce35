#include "kicking/policy/predictive/drive_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kicking/policy/drive.hpp"

namespace trivela::kicking {
namespace {

/// A unit vector turned by a small angle: series of sine and cosine, good to 1e-6 at 0.3 rad, and made a unit again.
Eigen::Vector2d turned(const Eigen::Vector2d& unit, double angle_rad) {
  const double square = angle_rad * angle_rad;
  const double s = angle_rad * (1.0 - square / 6.0 * (1.0 - square / 20.0));
  const double c = 1.0 - 0.5 * square * (1.0 - square / 12.0 * (1.0 - square / 30.0));
  const Eigen::Vector2d result(c * unit.x() - s * unit.y(), s * unit.x() + c * unit.y());
  return result * (1.5 - 0.5 * result.squaredNorm());
}

}  // namespace

DriveMotion::DriveMotion(const Pose& pose, const Twist& twist)
    : position_m(pose.x_m, pose.y_m),
      heading_rad(pose.heading_rad),
      forward(direction(pose.heading_rad)),
      velocity_mps(twist.vx_mps * Eigen::Vector2d(forward.y(), -forward.x()) + twist.vy_mps * forward),
      omega_radps(twist.omega_radps) {}

Twist DriveMotion::twist() const {
  return {velocity_mps.x() * forward.y() - velocity_mps.y() * forward.x(), velocity_mps.dot(forward), omega_radps};
}

void DriveMotion::hasten(const Twist& command, const PolicyConfig& config, double dt_s) {
  const Eigen::Vector2d wanted =
      command.vx_mps * Eigen::Vector2d(forward.y(), -forward.x()) + command.vy_mps * forward - velocity_mps;
  const double allowed = config.max_brake_mps2 * dt_s, change = wanted.norm();
  velocity_mps += change > allowed ? Eigen::Vector2d(allowed / change * wanted) : wanted;
  const double turn = config.max_turn_acceleration_radps2 * dt_s;
  omega_radps += std::clamp(command.omega_radps - omega_radps, -turn, turn);
}

void DriveMotion::coast(double dt_s) {
  position_m += dt_s * velocity_mps;
  heading_rad += dt_s * omega_radps;
  forward = turned(forward, dt_s * omega_radps);
}

void DriveMotion::step(const Twist& command, const PolicyConfig& config, double dt_s) {
  const Eigen::Vector2d velocity_before = velocity_mps;
  const double omega_before = omega_radps;
  hasten(command, config, dt_s);
  position_m += 0.5 * dt_s * (velocity_before + velocity_mps);
  const double turn = 0.5 * dt_s * (omega_before + omega_radps);
  heading_rad += turn;
  forward = turned(forward, turn);
}

namespace {

/// `ahead`: the target in R.
double turn_rate(DrivePlan plan, const DriveMotion& base, const PolicyConfig& config, const Eigen::Vector2d& ahead,
                 double alpha_rad, double braking) {
  const double side = -ahead.x() + alpha_rad * ahead.y();  // has the error's sign, alpha being small
  const double full_beyond_rad =
      config.max_turn_rate_radps * config.max_turn_rate_radps / (2.0 * braking * config.max_turn_acceleration_radps2);
  const bool full = plan == DrivePlan::kThrough || (ahead.y() < 0.0 && full_beyond_rad < 1.4);
  const bool other_way = side * base.omega_radps < 0.0 && ahead.y() < 0.0;
  if (full && !other_way) return std::copysign(config.max_turn_rate_radps, side);

  double error = std::atan2(-ahead.x(), ahead.y()) + alpha_rad;
  // Turning on the long way saves braking and coming back.
  const double saved = base.omega_radps * base.omega_radps / config.max_turn_acceleration_radps2;
  if (other_way && 2.0 * std::numbers::pi - std::abs(error) < std::abs(error) + saved) {
    error -= std::copysign(2.0 * std::numbers::pi, error);
  }
  if (plan == DrivePlan::kThrough) return std::copysign(config.max_turn_rate_radps, error);
  return turn_rate_for(error, config.moving_turn_gain_hz, config, braking);
}

}  // namespace

Twist command_of(DrivePlan plan, const DriveMotion& base, const PolicyConfig& config, const Eigen::Vector2d& target_m,
                 double dribble_mps, double lateral_transfer, double ball_speed_mps, const DriveStyle& style) {
  const Eigen::Vector2d line = target_m - base.position_m;
  const Eigen::Vector2d right(base.forward.y(), -base.forward.x());
  const Eigen::Vector2d ahead(line.dot(right), line.dot(base.forward));
  const double alpha = lateral_transfer * base.velocity_mps.dot(right) / ball_speed_mps;
  Twist command;
  command.omega_radps = turn_rate(plan, base, config, ahead, alpha, 0.75 * style.brake_ratio);
  const Eigen::Vector2d velocity = dribble_towards(ahead, config, style.speed_ratio * dribble_mps);
  command.vx_mps = std::clamp(style.side_ratio * velocity.x(), -config.max_sideways_mps, config.max_sideways_mps);
  command.vy_mps = velocity.y();
  return command;
}

}  // namespace trivela::kicking
