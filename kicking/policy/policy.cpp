#include "kicking/policy/policy.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "kicking/policy/policy_output.hpp"

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

/// Nothing is decided: why not, and how to drive meanwhile.
PolicyOutput hold(const PolicyConfig& config, const Goal& goal, Reason reason, const Twist& drive) {
  PolicyOutput output = describe(config, goal, {});
  output.reason = reason;
  output.drive = drive;
  return output;
}

void begin_possession(const Policy& policy, PossessionMemory& memory, std::uint32_t possession_id) {
  if (memory.possession_id == possession_id) return;
  if (policy.facts().plays()) {
    policy.clear(memory);
  } else {
    memory.interrupt();
    memory.fired_t_ns.reset();
  }
  memory.possession_id = possession_id;
}

/// The drive command that keeps the ball where it may be carried.
Twist within_reach(const PolicyConfig& config, const RobotModel& robot, const Pose& pose,
                   const PossessionMemory& memory, const Twist& drive) {
  const Eigen::Vector2d forward(-std::sin(pose.heading_rad), std::cos(pose.heading_rad));
  return carry_reach(config, robot, memory).keep(drive, {pose.x_m, pose.y_m}, forward);
}

/// A kick that no kicker has is none, and a command that is no number stops the robot. What a log needs is a number.
void refuse_nonsense(const PolicyConfig& config, const RobotModel& robot, PolicyOutput& output) {
  if (static_cast<std::size_t>(output.reason) >= kReasonNames.size()) output.reason = Reason::kWaiting;
  bool numbers = true;
  for (double* const number :
       {&output.target_x_m, &output.target_y_m, &output.target_z_m, &output.distance_m, &output.alpha_rad,
        &output.beta_rad, &output.left_m, &output.right_m, &output.fire_after_s}) {
    if (std::isfinite(*number)) continue;
    numbers = false;
    *number = 0.0;
  }
  for (OptionalDouble* const p : {&output.p_on_target, &output.p_goal})
    if (*p && !(**p >= 0.0 && **p <= 1.0)) *p = std::nullopt;
  const bool in_cycle = output.fire_after_s >= 0.0 && output.fire_after_s <= config.cycle_s;
  if (output.reason == Reason::kFire && (!numbers || !in_cycle || !output.power || output.kick_kind >= robot.kinds()))
    output.reason = Reason::kOutOfRange;
  if (output.lever_kind >= robot.kinds()) output.lever_kind = 0;
  Twist& drive = output.drive;
  if (!std::isfinite(drive.vx_mps + drive.vy_mps + drive.omega_radps)) drive = {};
  drive.vx_mps = std::clamp(drive.vx_mps, -config.max_forward_mps, config.max_forward_mps);
  drive.vy_mps = std::clamp(drive.vy_mps, -config.max_forward_mps, config.max_forward_mps);
  drive.omega_radps = std::clamp(drive.omega_radps, -config.max_turn_rate_radps, config.max_turn_rate_radps);
}

/// What the rule says. An exception of a policy from outside names it, the policy's own being nested in it.
PolicyOutput asked(const Policy& policy, const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                   const PolicyInput& input, PossessionMemory& memory) try {
  return policy.ask(config, robot, goal, input, memory);
} catch (const std::exception& error) {
  if (policy.place() == kNoPlace || policy.facts().needs_program()) throw;
  std::throw_with_nested(std::runtime_error("policy " + std::string{policy.facts().name} + ": " + error.what()));
} catch (...) {
  throw std::runtime_error("policy " + std::string{policy.facts().name} + ": threw something else than an exception");
}

/// The policy's own rule, within what holds for every policy.
PolicyOutput ask(const Policy& policy, const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                 const PolicyInput& input, PossessionMemory& memory) {
  const bool drive = !policy.facts().plays();
  begin_possession(policy, memory, input.possession_id);
  memory.watch(config, input);
  if (const Reason hindered = hindrance(config, input); hindered != Reason::kFire) {
    memory.interrupt();
    return hold(config, goal, hindered, {});
  }
  const bool pending = order_pending(config, input, memory);
  // Between a drive's order and its release nothing may change: the next velocity and the way back are for later.
  if (drive && pending) return hold(config, goal, Reason::kOrderPending, memory.pending_command());
  if (!drive && config.rules.carry_limit_m > 0.0 && !memory.taken_m) memory.taken_m = held_ball(input.pose, robot);
  PolicyOutput output = asked(policy, config, robot, goal, input, memory);
  if (policy.place() != kNoPlace) refuse_nonsense(config, robot, output);
  if (!drive) {
    if (memory.taken_m) output.drive = within_reach(config, robot, input.pose, memory, output.drive);
    if (!may_shoot(config, robot, input, output)) output.reason = Reason::kOwnHalf;
  }
  if (pending) {
    output.reason = Reason::kOrderPending;
  } else if (output.reason == Reason::kFire && !input.kicker_ready) {
    output.reason = Reason::kKickerNotReady;
  }
  output.fire = output.reason == Reason::kFire;
  if (!output.fire) return output;
  memory.fired_t_ns = input.t_ns;
  memory.order(config.test_drive, output.drive);
  return output;
}

/// The motion with its velocity turned counter-clockwise by the angle.
Twist turned_twist(const Twist& twist, double angle_rad) {
  const Eigen::Vector2d velocity_mps = rotate({twist.vx_mps, twist.vy_mps}, angle_rad);
  return {velocity_mps.x(), velocity_mps.y(), twist.omega_radps};
}

}  // namespace

PolicyMemory::PolicyMemory(PolicyName policy)
    : policy_(policies()[static_cast<std::size_t>(policy)]), memory_(policy_->new_memory()) {}

PolicyMemory::PolicyMemory(const PolicyMemory& other)
    : policy_(other.policy_), memory_(other.memory_ ? policy_->copy(*other.memory_) : nullptr) {}

PolicyMemory& PolicyMemory::operator=(const PolicyMemory& other) {
  if (this != &other) *this = PolicyMemory(other);
  return *this;
}

PossessionMemory& PolicyMemory::of(const Policy& policy) {
  if (!memory_ || !policy.remembers(*memory_)) memory_ = policy.new_memory();
  policy_ = &policy;
  return *memory_;
}

PolicyOutput evaluate(PolicyName name, const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                      const PolicyInput& input, PolicyMemory& memory) {
  const Policy& policy = *policies()[static_cast<std::size_t>(name)];
  PossessionMemory& own = memory.of(policy);
  if (robot.direction_rad == 0.0) return ask(policy, config, robot, goal, input, own);
  // A robot that faces where its ball goes kicks straight; the ball's place in its arms is off by some millimetres.
  PolicyInput turned = input;
  turned.pose.heading_rad += robot.direction_rad;
  turned.twist = turned_twist(input.twist, -robot.direction_rad);
  PolicyOutput output = ask(policy, config, robot, goal, turned, own);
  output.drive = turned_twist(output.drive, robot.direction_rad);
  return output;
}

}  // namespace trivela::kicking
