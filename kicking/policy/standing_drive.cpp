#include "kicking/policy/judgement.hpp"
#include "kicking/policy/settling.hpp"
#include "kicking/policy/test_drive.hpp"

namespace trivela::kicking {

Judgement judge_standing_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                               const PolicyInput& input, DriveMemory& memory) {
  const auto& powers = config.test_drive.powers;
  Judgement judgement = describe(config, goal, {});
  judgement.distance_m = (target_on_line(config, goal) - held_ball(input.pose, robot)).norm();
  if (memory.level >= powers.size()) {
    judgement.reason = Reason::kDriveFinished;
    return judgement;
  }
  judgement.power = powers[memory.level];
  judgement.reason = settle(config, input, memory.settling_since_t_ns);
  const Eigen::Vector2d target = target_on_line(config, goal);
  const double astray_rad = wrap_angle(bearing({input.pose.x_m, input.pose.y_m}, target) - input.pose.heading_rad);
  if (judgement.reason == Reason::kFire && std::abs(astray_rad) > radians(30.0)) judgement.reason = Reason::kNotAligned;
  return judgement;
}

}  // namespace trivela::kicking
