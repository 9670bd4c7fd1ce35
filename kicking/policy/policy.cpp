#include "kicking/policy/policy.hpp"

#include <cassert>
#include <cmath>

#include "kicking/policy/judgement.hpp"
#include "kicking/policy/moving.hpp"
#include "kicking/policy/stopped.hpp"

namespace trivela::kicking {
namespace {

bool finite(const Pose& pose, const Twist& twist) {
  // A sum is finite only if every term is.
  return std::isfinite(pose.x_m + pose.y_m + pose.heading_rad + twist.vx_mps + twist.vy_mps + twist.omega_radps);
}

/// Why nothing may be decided in this cycle; kFire: something may.
Reason hindrance(const PolicyConfig& config, const PolicyInput& input) {
  if (!input.playing) return Reason::kNotPlaying;
  if (!(input.state_age_s <= config.max_state_age_s) || !finite(input.pose, input.twist)) return Reason::kStaleState;
  if (!input.possession) return Reason::kNoBall;
  return Reason::kFire;
}

bool order_pending(const PolicyConfig& config, const PolicyInput& input, const PolicyMemory& memory) {
  return memory.fired_t_ns && 1e-9 * static_cast<double>(input.t_ns - *memory.fired_t_ns) < config.order_hold_s;
}

}  // namespace

const char* name(PolicyName policy) { return policy == PolicyName::kStopped ? "stopped" : "moving"; }

const char* name(Reason reason) {
  switch (reason) {
    case Reason::kFire:
      return "fire";
    case Reason::kNotPlaying:
      return "not_playing";
    case Reason::kNoBall:
      return "no_ball";
    case Reason::kKickerNotReady:
      return "kicker_not_ready";
    case Reason::kOrderPending:
      return "order_pending";
    case Reason::kApproaching:
      return "approaching";
    case Reason::kTurning:
      return "turning";
    case Reason::kSettling:
      return "settling";
    case Reason::kNotAligned:
      return "not_aligned";
    case Reason::kOutOfRange:
      return "out_of_range";
    case Reason::kStaleState:
      return "stale_state";
  }
  assert(false);
  return "unknown";
}

Judgement judge(PolicyName policy, const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                const PolicyInput& input, PolicyMemory& memory) {
  if (memory.possession_id != input.possession_id) {
    memory = {};
    memory.possession_id = input.possession_id;
  }

  const Reason hindered = hindrance(config, input);
  if (hindered != Reason::kFire) {
    memory.turning = false;
    memory.settling_since_t_ns.reset();
    Judgement held = describe(config, goal, {});
    held.reason = hindered;
    return held;
  }
  const auto judge_policy = policy == PolicyName::kStopped ? judge_stopped : judge_moving;
  Judgement judgement = judge_policy(config, robot, goal, input, memory);
  if (order_pending(config, input, memory)) {
    judgement.reason = Reason::kOrderPending;
  } else if (judgement.reason == Reason::kFire && !input.kicker_ready) {
    judgement.reason = Reason::kKickerNotReady;
  }
  judgement.fire = judgement.reason == Reason::kFire;
  if (judgement.fire) memory.fired_t_ns = input.t_ns;
  return judgement;
}

}  // namespace trivela::kicking
