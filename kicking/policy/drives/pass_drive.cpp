#include <algorithm>
#include <cmath>

#include "kicking/policy/drive.hpp"
#include "kicking/policy/drives/test_drive.hpp"
#include "kicking/policy/policy_output.hpp"
#include "kicking/policy/settling.hpp"

namespace trivela::kicking {
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

}  // namespace trivela::kicking
