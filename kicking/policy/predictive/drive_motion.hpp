#pragma once

#include "kicking/geometry/frames.hpp"
#include "kicking/outcome/crossing_spread.hpp"
#include "kicking/policy/policy_config.hpp"

namespace trivela::kicking {

/// A base on its way under a drive command, in F. It changes its velocity over ground by max_brake_mps2 at most, its
/// turn rate by max_turn_acceleration_radps2, and reaches what is commanded otherwise.
struct DriveMotion {
  Eigen::Vector2d position_m{0.0, 0.0};
  double heading_rad = 0.0;
  Eigen::Vector2d forward{0.0, 1.0};       ///< unit vector of the heading
  Eigen::Vector2d velocity_mps{0.0, 0.0};  ///< over ground
  double omega_radps = 0.0;

  DriveMotion(const Pose& pose, const Twist& twist);

  Pose pose() const { return {position_m.x(), position_m.y(), heading_rad}; }
  Twist twist() const;
  ReleaseState release(double ball_offset_m) const {
    return {position_m + ball_offset_m * forward, forward, velocity_mps, omega_radps};
  }

  /// Changes the velocities alone, as dt [s] of the command would.
  void hasten(const Twist& command, const PolicyConfig& config, double dt_s);

  /// Goes on as it moves for dt [s], which may be negative.
  void coast(double dt_s);

  /// Moves for dt [s], by the mean velocities of its ends.
  void step(const Twist& command, const PolicyConfig& config, double dt_s);
};

}  // namespace trivela::kicking
