#pragma once

#include "kicking/policy/rule.hpp"

namespace trivela::kicking {

struct StoppedMemory : PossessionMemory {
  bool turning = false;  ///< has come to rest, turns or settles
  std::optional<std::int64_t> settling_since_t_ns;

  /// The phases begin again.
  void interrupt() override {
    turning = false;
    settling_since_t_ns.reset();
  }
};

/// The method before the paper, "a two-step behaviour": drive into range if the target is beyond it, brake, turn on the
/// spot, be within the tolerance and at rest for settle_s, kick. reason kFire: it would kick now, the common conditions
/// aside.
PolicyOutput evaluate_stopped(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                              const PolicyInput& input, StoppedMemory& memory);

}  // namespace trivela::kicking
