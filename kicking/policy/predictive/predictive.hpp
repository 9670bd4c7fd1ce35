#pragma once

#include "kicking/policy/policy.hpp"

namespace trivela::kicking {

/// Fires where the probability of a ball on target now is worth more than any later moment's, weighed with keeping the
/// ball until then (docs/policies.md).
Judgement judge_predictive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                           const PolicyInput& input, PolicyMemory& memory);

/// The same with the probability corrected by config.learned, where there is one.
Judgement judge_learned(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                        PolicyMemory& memory);

/// What the policy sees while nothing may be decided: the opponent.
void watch_predictive(const PolicyConfig& config, const PolicyInput& input, PolicyMemory& memory);

}  // namespace trivela::kicking
