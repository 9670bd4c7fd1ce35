#pragma once

#include <Eigen/Core>

#include "kicking/policy/policy_config.hpp"

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

}  // namespace trivela::kicking
