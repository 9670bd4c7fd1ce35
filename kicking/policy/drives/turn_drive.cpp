#include <cmath>

#include "kicking/policy/drive.hpp"
#include "kicking/policy/drives/test_drive.hpp"
#include "kicking/policy/policy_output.hpp"

namespace trivela::kicking {
namespace {

constexpr double kFewCycles = 3.0;  // within which an order must follow the alignment; a later kick would tell nothing

/// The allowed error of this step, as an angle.
double allowed_rad(const TestDriveConfig& config, const TurnDriveMemory& memory) {
  return 0.5 * (memory.low_rad + memory.high_rad.value_or(config.turn_widest_rad));
}

/// Takes in what was seen of the last kick. Once a step has its kicks, their mean halves the interval: balls that went
/// beyond the target in the sense of turning left too late, so that a wider error must be allowed.
void learn(const PolicyConfig& config, const PolicyInput& input, double omega_radps, TurnDriveMemory& memory) {
  if (!memory.awaited_possession || !input.last_kick) return;
  if (input.last_kick->possession_id != *memory.awaited_possession) return;
  memory.awaited_possession.reset();
  if (!input.last_kick->x_cross_m) return;
  // Counter-clockwise, the pointing line comes from the right and goes left.
  memory.late_sum_m += std::copysign(1.0, omega_radps) * (config.target_x_m - *input.last_kick->x_cross_m);
  const TestDriveConfig& drive = config.test_drive;
  if (++memory.kicks < drive.turn_kicks_per_step) return;
  const double tried = allowed_rad(drive, memory);
  (memory.late_sum_m > 0.0 ? memory.low_rad : memory.high_rad.emplace()) = tried;
  memory.kicks = 0;
  memory.late_sum_m = 0.0;
  if (++memory.step < drive.turn_steps) return;
  memory.step = 0;
  memory.low_rad = 0.0;
  memory.high_rad.reset();
  memory.passing = false;
  ++memory.level;
}

}  // namespace

PolicyOutput evaluate_turn_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                 const PolicyInput& input, TurnDriveMemory& progress) {
  const TestDriveConfig& drive = config.test_drive;
  if (progress.level < drive.turn_radps.size()) learn(config, input, drive.turn_radps[progress.level], progress);
  if (progress.level >= drive.turn_radps.size()) {
    PolicyOutput output = describe(config, goal, {});
    output.reason = Reason::kDriveFinished;
    return output;
  }
  const double omega_radps = drive.turn_radps[progress.level];
  const double sense = std::copysign(1.0, omega_radps);
  const Shot shot = drive_shot(config, robot, goal, input);
  PolicyOutput output = describe(config, goal, shot);
  const Eigen::Vector2d target = target_on_line(config, goal);
  AlignmentRule rule = config.alignment;
  rule.half_width_m = 0.0;  // the allowed error is all that there is
  output.beta_rad = sense * allowed_rad(drive, progress);
  output.alignment() = align(input.pose, 0.0, output.beta_rad, omega_radps, target, rule);

  if (!progress.passing) {
    const double start_rad = bearing({input.pose.x_m, input.pose.y_m}, target) - sense * drive.turn_lead_rad;
    const double error_rad = wrap_angle(start_rad - input.pose.heading_rad);
    output.drive.omega_radps = turn_rate_for(error_rad, config.stopped_turn_gain_hz, config);
    const bool there = std::abs(error_rad) <= 3.0 * drive.aim_tolerance_rad &&
                       std::abs(input.twist.omega_radps) <= drive.rest_turn_rate_radps;
    output.reason = there ? Reason::kKickerNotReady : Reason::kTurning;
    progress.passing = there && input.kicker_ready;
    if (!progress.passing) return output;
  }
  output.drive.omega_radps = omega_radps;
  // How far the pointing line still has to go to the target's middle.
  const double to_go_m = output.offset_right_m ? sense * *output.offset_right_m : HUGE_VAL;
  const double allowed_m = sense > 0.0 ? output.right_m : output.left_m;
  const double late_m = allowed_m - to_go_m;
  output.aligned =
      late_m >= 0.0 && late_m <= kFewCycles * config.cycle_s * std::abs(omega_radps) * 2.0 *
                                     output.centre_distance_m;  // at 45 degrees the line moves at 2 d omega
  output.reason = Reason::kNotAligned;
  if (output.aligned) output.reason = shot.reachable ? Reason::kFire : Reason::kOutOfRange;
  if (late_m > output.centre_distance_m) progress.passing = false;
  return output;
}

}  // namespace trivela::kicking
