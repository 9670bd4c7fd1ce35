#include "kicking/policy/judgement.hpp"
#include "kicking/policy/settling.hpp"
#include "kicking/policy/test_drive.hpp"

namespace trivela::kicking {

Judgement judge_standing_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                               const PolicyInput& input, PolicyMemory& memory) {
  const auto& powers = config.test_drive.powers;
  Judgement judgement = describe(config, goal, {});
  judgement.distance_m = (target_on_line(config, goal) - held_ball(input.pose, robot)).norm();
  if (memory.drive.level >= powers.size()) {
    judgement.reason = Reason::kDriveFinished;
    return judgement;
  }
  judgement.power = powers[memory.drive.level];
  judgement.reason = settle(config, input, memory);
  return judgement;
}

}  // namespace trivela::kicking
