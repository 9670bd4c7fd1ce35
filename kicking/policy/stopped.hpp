#pragma once

#include "kicking/policy/policy.hpp"

namespace trivela::kicking {

/// The method before the paper, "a two-step behaviour": drive into range if the target is beyond it, brake, turn on the
/// spot, be within the tolerance and at rest for settle_s, kick. reason kFire: it would kick now, the common conditions
/// aside.
Judgement judge_stopped(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                        PolicyMemory& memory);

}  // namespace trivela::kicking
