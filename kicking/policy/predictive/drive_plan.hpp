#pragma once

#include <array>

#include "kicking/policy/predictive/drive_motion.hpp"
#include "kicking/policy/predictive/learned_decision.hpp"

namespace trivela::kicking {

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
