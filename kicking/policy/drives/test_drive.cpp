#include "kicking/policy/drives/test_drive.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/policy/drive.hpp"
#include "kicking/policy/policy_output.hpp"

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

namespace {

constexpr double kAtMark_m = 0.2;         // beyond the noise of self-localisation
constexpr double kOrderCycles = 3.0;      // past the place of the kick, within which the order must go out
constexpr double kTooLate_m = 0.5;        // past it without an order: it starts over
constexpr double kAside_m = 0.5;          // off the way at the kick: somebody pushed the robot
const double kAstray_rad = radians(8.0);  // off the heading at the kick: the same

/// Drives to the start mark and stands there, facing +y of F: velocity in R.
Eigen::Vector2d towards_mark(const PolicyConfig& config, const Pose& robot, const Eigen::Vector2d& mark_m) {
  const Eigen::Vector2d way = to_robot(robot, mark_m);
  const double distance = way.norm();
  if (distance <= 0.5 * kAtMark_m) return {0.0, 0.0};
  return std::min(config.test_drive.approach_mps, std::sqrt(config.max_brake_mps2 * distance)) / distance * way;
}

/// A pass at `velocity_mps` along the unit vector `along` of F, and of R, since the robot faces +y. The kick is due
/// straight before the target, at `distance_m`. At 0 m/s it stands there: the kick that the others are held against.
PolicyOutput evaluate_pass(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                           const PolicyInput& input, DriveMemory& memory, const Eigen::Vector2d& along,
                           double velocity_mps, double distance_m) {
  const Shot shot = drive_shot(config, robot, goal, input);
  PolicyOutput output = describe(config, goal, shot);
  const Eigen::Vector2d target = target_on_line(config, goal);
  output.alignment() = align(input.pose, 0.0, 0.0, 0.0, target, config.alignment);
  output.drive.omega_radps = turn_rate_for(-wrap_angle(input.pose.heading_rad), config.stopped_turn_gain_hz, config);

  const Eigen::Vector2d position(input.pose.x_m, input.pose.y_m);
  const Eigen::Vector2d kick_place = target - Eigen::Vector2d(0.0, distance_m);
  const Eigen::Vector2d ahead = std::copysign(1.0, velocity_mps) * along;
  const double passed_m = (position - kick_place).dot(ahead);
  const bool standing = velocity_mps == 0.0;
  bool& passing = memory.passing;
  if (!passing) {
    memory.settling_since_t_ns.reset();
    const Eigen::Vector2d mark = standing ? kick_place : kick_place - config.test_drive.run_up_m * ahead;
    const Eigen::Vector2d velocity = towards_mark(config, input.pose, mark);
    output.drive.vx_mps = velocity.x();
    output.drive.vy_mps = velocity.y();
    const bool there = (mark - position).norm() <= kAtMark_m &&
                       std::hypot(input.twist.vx_mps, input.twist.vy_mps) <= config.test_drive.rest_speed_mps &&
                       std::abs(wrap_angle(input.pose.heading_rad)) <= 2.0 * config.test_drive.aim_tolerance_rad;
    output.reason = there ? Reason::kKickerNotReady : Reason::kApproaching;
    passing = there && input.kicker_ready;
    if (!passing) return output;
  }
  output.drive.vx_mps = velocity_mps * along.x();
  output.drive.vy_mps = velocity_mps * along.y();
  if (standing) {
    output.reason = settle(config, input, memory.settling_since_t_ns);
  } else if (passed_m >= 0.0 && passed_m <= kOrderCycles * config.cycle_s * std::abs(velocity_mps)) {
    output.reason = Reason::kFire;
  } else {
    output.reason = Reason::kNotAligned;
  }
  const Eigen::Vector2d off = position - kick_place;
  const bool on_its_way = std::abs(wrap_angle(input.pose.heading_rad)) <= kAstray_rad &&
                          std::abs(along.x() * off.y() - along.y() * off.x()) <= kAside_m;
  if (output.reason == Reason::kFire && !shot.reachable) output.reason = Reason::kOutOfRange;
  if (output.reason == Reason::kFire && !on_its_way) output.reason = Reason::kNotAligned;
  if (passed_m > kTooLate_m) passing = false;
  return output;
}

PolicyOutput finished(const PolicyConfig& config, const Goal& goal) {
  PolicyOutput output = describe(config, goal, {});
  output.reason = Reason::kDriveFinished;
  return output;
}

}  // namespace

PolicyOutput evaluate_lateral_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                    const PolicyInput& input, DriveMemory& memory) {
  const auto& velocities = config.test_drive.lateral_mps;
  if (memory.level >= velocities.size()) return finished(config, goal);
  return evaluate_pass(config, robot, goal, input, memory, {1.0, 0.0}, velocities[memory.level],
                       config.test_drive.distance_m);
}

PolicyOutput evaluate_straight_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                     const PolicyInput& input, DriveMemory& memory) {
  const auto& velocities = config.test_drive.straight_mps;
  if (memory.level >= velocities.size()) return finished(config, goal);
  return evaluate_pass(config, robot, goal, input, memory, {0.0, 1.0}, velocities[memory.level],
                       config.test_drive.straight_distance_m);
}

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
