#include "kicking/policy/drives/test_drive.hpp"
#include "kicking/policy/policy_output.hpp"
#include "kicking/policy/settling.hpp"

namespace trivela::kicking {

PolicyOutput evaluate_standing_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                     const PolicyInput& input, DriveMemory& memory) {
  const auto& powers = config.test_drive.powers;
  PolicyOutput output = describe(config, goal, {});
  output.distance_m = (target_on_line(config, goal) - held_ball(input.pose, robot)).norm();
  if (memory.level >= powers.size()) {
    output.reason = Reason::kDriveFinished;
    return output;
  }
  output.power = powers[memory.level];
  output.kick_kind = output.lever_kind = static_cast<std::uint8_t>(config.test_drive.kick_kind);
  output.reason = settle(config, input, memory.settling_since_t_ns);
  if (output.reason == Reason::kFire && input.lever_kind != output.kick_kind) output.reason = Reason::kKickerNotReady;
  const Eigen::Vector2d target = target_on_line(config, goal);
  const double astray_rad = wrap_angle(bearing({input.pose.x_m, input.pose.y_m}, target) - input.pose.heading_rad);
  if (output.reason == Reason::kFire && std::abs(astray_rad) > radians(30.0)) output.reason = Reason::kNotAligned;
  return output;
}

}  // namespace trivela::kicking
