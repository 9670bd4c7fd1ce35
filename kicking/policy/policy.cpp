#include "kicking/policy/policy.hpp"

#include <array>
#include <cassert>
#include <cmath>

#include "kicking/policy/judgement.hpp"
#include "kicking/policy/moving.hpp"
#include "kicking/policy/predictive/predictive.hpp"
#include "kicking/policy/stopped.hpp"
#include "kicking/policy/test_drive.hpp"

namespace trivela::kicking {
namespace {

bool finite(const PolicyInput& input) {
  const Pose& pose = input.pose;
  const Twist& twist = input.twist;
  // A sum is finite only if every term is.
  return std::isfinite(pose.x_m + pose.y_m + pose.heading_rad + twist.vx_mps + twist.vy_mps + twist.omega_radps +
                       input.sd_position_m + input.sd_heading_rad);
}

/// Why nothing may be decided in this cycle; kFire: something may.
Reason hindrance(const PolicyConfig& config, const PolicyInput& input) {
  if (!input.playing) return Reason::kNotPlaying;
  if (!(input.state_age_s <= config.max_state_age_s) || !finite(input)) return Reason::kStaleState;
  if (!input.possession) return Reason::kNoBall;
  return Reason::kFire;
}

bool is_drive(PolicyName policy) {
  return policy >= PolicyName::kStandingDrive && policy <= PolicyName::kStraightDrive;
}

bool is_predictive(PolicyName policy) { return policy >= PolicyName::kPredictive; }

using Rule = Judgement (*)(const PolicyConfig&, const RobotModel&, const Goal&, const PolicyInput&, PolicyMemory&);

/// In the order of PolicyName.
constexpr std::array<Rule, kPolicyCount> kRules{judge_stopped,       judge_moving,     judge_standing_drive,
                                                judge_lateral_drive, judge_turn_drive, judge_straight_drive,
                                                judge_predictive,    judge_learned,    judge_predictive};

/// Nothing is decided: why not, and how to drive meanwhile.
Judgement hold(const PolicyConfig& config, const Goal& goal, Reason reason, const Twist& drive) {
  Judgement judgement = describe(config, goal, {});
  judgement.reason = reason;
  judgement.drive = drive;
  return judgement;
}

/// The policy's own rule, where something may be decided.
Judgement judge_freely(PolicyName policy, const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                       const PolicyInput& input, PolicyMemory& memory) {
  Judgement judgement = kRules[static_cast<std::size_t>(policy)](config, robot, goal, input, memory);
  if (order_pending(config, input, memory)) {
    judgement.reason = Reason::kOrderPending;
  } else if (judgement.reason == Reason::kFire && !input.kicker_ready) {
    judgement.reason = Reason::kKickerNotReady;
  }
  judgement.fire = judgement.reason == Reason::kFire;
  if (judgement.fire) {
    memory.fired_t_ns = input.t_ns;
    if (is_drive(policy)) count_drive_kick(policy, config, input, judgement.drive, memory.drive);
  }
  return judgement;
}

}  // namespace

const char* name(PolicyName policy) {
  switch (policy) {
    case PolicyName::kStopped:
      return "stopped";
    case PolicyName::kMoving:
      return "moving";
    case PolicyName::kStandingDrive:
      return "standing_drive";
    case PolicyName::kLateralDrive:
      return "lateral_drive";
    case PolicyName::kTurnDrive:
      return "turn_drive";
    case PolicyName::kStraightDrive:
      return "straight_drive";
    case PolicyName::kPredictive:
      return "predictive";
    case PolicyName::kLearned:
      return "learned";
    case PolicyName::kOracle:
      return "oracle";
  }
  assert(false);
  return "unknown";
}

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
    case Reason::kDriveFinished:
      return "drive_finished";
    case Reason::kUnlikely:
      return "unlikely";
    case Reason::kWaiting:
      return "waiting";
  }
  assert(false);
  return "unknown";
}

Judgement judge(PolicyName policy, const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                const PolicyInput& input, PolicyMemory& memory) {
  if (memory.possession_id != input.possession_id) {
    const TestDriveMemory drive = memory.drive;
    memory = {};
    memory.possession_id = input.possession_id;
    memory.drive = drive;
    memory.drive.passing = false;
  }

  if (is_predictive(policy)) watch_predictive(config, input, memory);
  const Reason hindered = hindrance(config, input);
  if (hindered != Reason::kFire) {
    memory.turning = false;
    memory.settling_since_t_ns.reset();
    memory.drive.passing = false;
    return hold(config, goal, hindered, {});
  }
  // Between a drive's order and its release nothing may change: the next velocity and the way back are for later.
  if (is_drive(policy) && order_pending(config, input, memory))
    return hold(config, goal, Reason::kOrderPending, memory.drive.command);
  return judge_freely(policy, config, robot, goal, input, memory);
}

}  // namespace trivela::kicking
