#pragma once

#include <Eigen/Core>
#include <optional>

#include "kicking/policy/rule.hpp"

namespace trivela::kicking {

/// The power question of one cycle: what speed does the kick need, and which set-point gives it?
struct Shot : ShotNumbers {
  TurnedPose release;      ///< of the robot, when the ball leaves if the order goes out now
  Elevation exit_angle{};  ///< that v0 and v_kick hold for: the power's own
  bool too_far = false;    ///< no set-point is fast enough
  bool reachable = false;  ///< a set-point reaches the height, or the least one still passes below the bar
};

/// Aim point on the goal line, in F.
Eigen::Vector2d target_on_line(const PolicyConfig& config, const Goal& goal);

/// The same past a keeper: the corner that is nearer to the heading when it is first asked, and that from then on.
Eigen::Vector2d target_past(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                            const PolicyInput& input, PossessionMemory& memory);

/// Centre of the ball in the handler, in F.
Eigen::Vector2d held_ball(const Pose& robot, const RobotModel& model);
Eigen::Vector2d held_ball(const TurnedPose& robot, const RobotModel& model);

/// Shot of a robot taken to stand still: V_kick = V0, from where the ball is now.
Shot stopped_shot(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                  const Eigen::Vector2d& target_m);

/// The same of a test drive: always by the exact height law, whatever is played by.
Shot drive_shot(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input);

/// Shot of a moving robot by the configured height and motion laws.
Shot moving_shot(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                 const Eigen::Vector2d& target_m);

}  // namespace trivela::kicking
