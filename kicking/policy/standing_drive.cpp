#include <algorithm>
#include <cmath>

#include "kicking/policy/judgement.hpp"
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
  const bool at_rest = std::hypot(input.twist.vx_mps, input.twist.vy_mps) <= config.rest_speed_mps &&
                       std::abs(input.twist.omega_radps) <= config.rest_turn_rate_radps;
  if (!at_rest) {
    memory.settling_since_t_ns.reset();
    judgement.reason = Reason::kApproaching;
    return judgement;
  }
  if (!memory.settling_since_t_ns) memory.settling_since_t_ns = input.t_ns;
  const double settled_s = 1e-9 * static_cast<double>(input.t_ns - *memory.settling_since_t_ns);
  judgement.reason = settled_s >= config.settle_s ? Reason::kFire : Reason::kSettling;
  return judgement;
}

}  // namespace trivela::kicking
