#include "kicking/policy/stopped.hpp"

#include <cmath>

#include "kicking/geometry/time.hpp"
#include "kicking/policy/drive.hpp"
#include "kicking/policy/policy_output.hpp"

namespace trivela::kicking {
namespace {

/// Brings the phases up to date and names the one that holds the kick back, kFire if none does.
Reason stopped_phase(const PolicyConfig& config, const PolicyInput& input, double heading_error_rad,
                     StoppedMemory& memory) {
  const double speed = std::hypot(input.twist.vx_mps, input.twist.vy_mps);
  // Once at rest it takes twice the speed to be moving again, so that noise does not throw it back.
  if (speed > (memory.turning ? 2.0 : 1.0) * config.rest_speed_mps) {
    memory.interrupt();
    return Reason::kApproaching;
  }
  memory.turning = true;
  const bool settling = memory.settling_since_t_ns.has_value();
  const bool at_rest = std::abs(input.twist.omega_radps) <= (settling ? 2.0 : 1.0) * config.rest_turn_rate_radps;
  const bool on_target = std::abs(heading_error_rad) <= (settling ? 2.0 : 1.0) * config.aim_tolerance_rad;
  if (!at_rest || !on_target) {
    memory.settling_since_t_ns.reset();
    return Reason::kTurning;
  }
  if (!settling) memory.settling_since_t_ns = input.t_ns;
  const double settled_s = seconds(input.t_ns - *memory.settling_since_t_ns);
  return settled_s >= config.settle_s && std::abs(heading_error_rad) <= config.aim_tolerance_rad ? Reason::kFire
                                                                                                 : Reason::kSettling;
}

}  // namespace

PolicyOutput evaluate_stopped(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                              const PolicyInput& input, StoppedMemory& memory) {
  const Eigen::Vector2d target = target_past(config, robot, goal, input, memory);
  const Shot shot = stopped_shot(config, robot, goal, input, target);
  PolicyOutput output = describe(config, goal, shot);
  output.target_x_m = target.x();
  output.alignment() = align(input.pose, 0.0, 0.0, 0.0, target, config.alignment);

  const double error = wrap_angle(bearing({input.pose.x_m, input.pose.y_m}, target) - input.pose.heading_rad);
  output.drive.omega_radps = turn_rate_for(error, config.stopped_turn_gain_hz, config);
  if (shot.too_far) {
    const Eigen::Vector2d velocity = dribble_towards(input.pose, target, config, dribble_mps(config, input));
    output.drive.vx_mps = velocity.x();
    output.drive.vy_mps = velocity.y();
    output.reason = velocity.isZero() ? Reason::kOutOfRange : Reason::kApproaching;
    memory.interrupt();
    return output;
  }
  output.reason = stopped_phase(config, input, error, memory);
  if (output.reason == Reason::kApproaching) output.drive = {};  // brakes; turns when it stands
  if (!shot.reachable) output.reason = Reason::kOutOfRange;
  return output;
}

}  // namespace trivela::kicking
