#pragma once

#include <array>

#include "kicking/geometry/frames.hpp"
#include "kicking/outcome/crossing_spread.hpp"
#include "kicking/policy/policy_config.hpp"
#include "kicking/policy/predictive/learned_decision.hpp"

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

/// How the robot turns while it drives on towards the goal. kOnto: comes to rest on the target, by the braking curve of
/// the other policies. kThrough: as fast as the base turns, through the target and back.
enum class DrivePlan { kOnto, kThrough };

/// How the robot drives: a plan, a style, and where on the goal line it turns to.
struct Way {
  DrivePlan plan = DrivePlan::kOnto;
  std::size_t style = 0;
  double aim_x_m = 0.0;  ///< in F
};

/// In the order of preference where they are worth the same. Braking as well instead of driving on was tried and gained
/// nothing (docs/policies.md).
inline constexpr std::array<DrivePlan, 2> kDrivePlans{DrivePlan::kOnto, DrivePlan::kThrough};

/// The plan's drive command in a state of motion. It turns the way that is quicker from the present turn rate, to where
/// a standing turn rate sends the ball to the target: bearing plus alpha = k_x v_x / ball_speed_mps.
Twist command_of(DrivePlan plan, const DriveMotion& base, const PolicyConfig& config, const Eigen::Vector2d& target_m,
                 double dribble_mps, double lateral_transfer, double ball_speed_mps, const DriveStyle& style = {});

}  // namespace trivela::kicking
