#pragma once

#include "kicking/policy/predictive/drive_plan.hpp"
#include "kicking/policy/predictive/opponent_watch.hpp"
#include "kicking/policy/rule.hpp"

namespace trivela::kicking {

struct PredictiveMemory : PossessionMemory {
  OpponentWatch opponent{};
  Way way{};                      ///< that it drives by
  std::uint32_t cycles_past = 0;  ///< in a row in which it looked past a keeper
  std::optional<Twist> command;   ///< of the last cycle
  std::optional<Twist> twist;     ///< of the robot in the last cycle
  double speed_jump_mps = 0.0;    ///< by which the twist changed more than the base can

  /// What is seen in every cycle, also while nothing may be decided: the opponent, the robot's own twist.
  void watch(const PolicyConfig& config, const PolicyInput& input);
};

/// Fires where the probability of a ball on target, past a tracked keeper of a goal, now is worth more than any later
/// moment's, weighed with keeping the ball until then (docs/policies.md).
PolicyOutput evaluate_predictive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                 const PolicyInput& input, PredictiveMemory& memory);

/// The same with the probability corrected by config.learned, where there is one.
PolicyOutput evaluate_learned(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                              const PolicyInput& input, PredictiveMemory& memory);

}  // namespace trivela::kicking
