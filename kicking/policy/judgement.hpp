#pragma once

#include "kicking/geometry/time.hpp"
#include "kicking/policy/rule.hpp"
#include "kicking/policy/shot.hpp"

namespace trivela::kicking {

/// A judgement with the target and the numbers of the shot; nothing decided yet.
inline Judgement describe(const PolicyConfig& config, const Goal& goal, const Shot& shot) {
  Judgement judgement;
  judgement.target_x_m = config.target_x_m;
  judgement.target_y_m = goal.y_m;
  judgement.target_z_m = config.target_height_m;
  judgement.distance_m = shot.distance_m;
  judgement.v0_mps = shot.v0_mps;
  judgement.v_kick_mps = shot.v_kick_mps;
  judgement.power = shot.power;
  judgement.predicted = shot.predicted;
  return judgement;
}

inline void set_alignment(Judgement& judgement, const Alignment& alignment) {
  judgement.aligned = alignment.aligned;
  judgement.offset_right_m = alignment.offset_right_m;
  judgement.left_m = alignment.left_m;
  judgement.right_m = alignment.right_m;
}

/// Does an order of this possession still have its time?
inline bool order_pending(const PolicyConfig& config, const PolicyInput& input, const PossessionMemory& memory) {
  return memory.fired_t_ns && seconds(input.t_ns - *memory.fired_t_ns) < config.order_hold_s;
}

}  // namespace trivela::kicking
