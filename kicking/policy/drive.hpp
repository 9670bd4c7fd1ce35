#pragma once

#include <Eigen/Core>

#include <cmath>

#include "kicking/geometry/time.hpp"
#include "kicking/policy/policy_config.hpp"
#include "kicking/policy/rule.hpp"

namespace trivela::kicking {

/// Turn rate [rad/s] that brings a heading error to zero: the least of gain * |error|, sqrt(2 a |error|) with `braking`
/// (three quarters) of the turning acceleration, and the greatest turn rate; with the error's sign. The error is wanted
/// minus actual, in [-pi, pi].
double turn_rate_for(double heading_error_rad, double gain_hz, const PolicyConfig& config, double braking = 0.75);

/// Dribbling velocity in R [m/s] towards a point of R: dribble_mps, or as fast as it can still brake at keep_off_m,
/// within the limits with the ball.
Eigen::Vector2d dribble_towards(const Eigen::Vector2d& ahead_m, const PolicyConfig& config, double dribble_mps);

/// The same towards a point of F.
Eigen::Vector2d dribble_towards(const Pose& robot, const Eigen::Vector2d& point_m, const PolicyConfig& config,
                                double dribble_mps);

/// Has the robot been at rest for the test drives' settle_s? kApproaching: it moves; kSettling: not yet; kFire: yes.
inline Reason settle(const PolicyConfig& config, const PolicyInput& input,
                     std::optional<std::int64_t>& settling_since_t_ns) {
  const TestDriveConfig& rule = config.test_drive;
  const bool at_rest = std::hypot(input.twist.vx_mps, input.twist.vy_mps) <= rule.rest_speed_mps &&
                       std::abs(input.twist.omega_radps) <= rule.rest_turn_rate_radps;
  if (!at_rest) {
    settling_since_t_ns.reset();
    return Reason::kApproaching;
  }
  if (!settling_since_t_ns) settling_since_t_ns = input.t_ns;
  const double settled_s = seconds(input.t_ns - *settling_since_t_ns);
  return settled_s >= rule.settle_s ? Reason::kFire : Reason::kSettling;
}

}  // namespace trivela::kicking
