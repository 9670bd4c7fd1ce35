#pragma once

#include <algorithm>
#include <optional>

#include "kicking/geometry/time.hpp"
#include "kicking/policy/policy.hpp"

namespace trivela::kicking::tests {

/// A robot in mid-field that may kick.
inline PolicyInput ready_at(const Pose& pose, const Twist& twist = {}) {
  PolicyInput input;
  input.pose = pose;
  input.twist = twist;
  input.playing = true;
  input.possession = true;
  input.possession_id = 1;
  input.kicker_ready = true;
  return input;
}

/// Settings by which geometry is told most easily: a height to aim at, the paper's w, a stopped policy that settles on
/// a degree.
inline PolicyConfig strict_config() {
  PolicyConfig config;
  config.height_law = HeightLaw::kExact;
  config.alignment.half_width_m = 0.1;
  config.aim_tolerance_rad = radians(1.0);
  config.settle_s = 0.25;
  config.rest_speed_mps = config.rest_turn_rate_radps = 0.15;
  return config;
}

/// What became of a possession.
struct Played {
  std::optional<PolicyOutput> fired;
  PolicyInput at;  ///< of the order, or the last cycle
  double seconds = 0.0;
};

/// Plays a possession without noise: the robot follows the drive command within the limits of acceleration, 20 ms a
/// cycle.
inline Played play(PolicyName policy, const PolicyConfig& config, const RobotModel& robot, PolicyInput input,
                   PolicyMemory& memory, double limit_s = 8.0) {
  Played played;
  for (; played.seconds < limit_s; played.seconds += config.cycle_s) {
    const PolicyOutput output = evaluate(policy, config, robot, {}, input, memory);
    played.at = input;
    if (output.fire) {
      played.fired = output;
      break;
    }
    const auto follow = [](double now, double wanted, double change) {
      return now + std::clamp(wanted - now, -change, change);
    };
    const double dv = config.max_brake_mps2 * config.cycle_s;
    const double dw = config.max_turn_acceleration_radps2 * config.cycle_s;
    input.twist = {follow(input.twist.vx_mps, output.drive.vx_mps, dv),
                   follow(input.twist.vy_mps, output.drive.vy_mps, dv),
                   follow(input.twist.omega_radps, output.drive.omega_radps, dw)};
    input.pose = advance(input.pose, input.twist, config.cycle_s);
    input.t_ns += nanoseconds(config.cycle_s);
  }
  return played;
}

/// The same with a fresh memory.
inline Played play(PolicyName policy, const PolicyConfig& config, const RobotModel& robot, const PolicyInput& input) {
  PolicyMemory memory;
  return play(policy, config, robot, input, memory);
}

}  // namespace trivela::kicking::tests
