#pragma once

#include "kicking/policy/rule.hpp"

namespace trivela::kicking {

struct MovingMemory : PossessionMemory {
  bool aligned_before = false;  ///< in the previous cycle
};

/// The paper's method (section 3.4): dribbles on towards the goal while it turns, and evaluates the alignment every
/// cycle. It fires on the first aligned sample; later ones count only while S2 is not extended, since beta leads the
/// entry into S2 alone. reason kFire: it would kick now, the common conditions aside.
PolicyOutput evaluate_moving(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                             const PolicyInput& input, MovingMemory& memory);

}  // namespace trivela::kicking
