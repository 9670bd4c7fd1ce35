#include "kicking/policy/shot.hpp"

#include <cmath>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/ballistics/moving_kick.hpp"
#include "kicking/policy/policy_output.hpp"

namespace trivela::kicking {
namespace {

constexpr int kBisections = 40;  // of a gap between set-points: 1e-11 of a power
constexpr int kRounds = 12;

/// What the robot's motion at the release gives to the ball, along and to the right of the line ball - target.
Carry carry_towards(const Eigen::Vector2d& line, const TurnedPose& release, const RobotModel& robot,
                    const Twist& twist) {
  const Transfer& transfer = robot.transfer_exact;
  const Eigen::Vector2d in_field = release.turn(
      transfer.lateral * (twist.vx_mps - twist.omega_radps * robot.ball_offset_m), transfer.along_mps(twist.vy_mps));
  const Eigen::Vector2d along = line.normalized();
  return {in_field.dot(along), in_field.dot(Eigen::Vector2d(along.y(), -along.x()))};
}

/// Exit speeds that the kick needs at one exit angle.
struct Speeds {
  OptionalDouble v0_mps;
  OptionalDouble v_kick_mps;
};

/// The angle of the least power whose kick is fast enough at its own angle, by bisection between the two set-points
/// around it; that of the last set-point where none is.
template <typename SpeedsAt>
double bisected_angle(const RobotModel& robot, const SpeedsAt& speeds_at) {
  const auto fast_enough = [&](double power) {
    const auto needed_mps = speeds_at(robot.exit_angle_at(power)).v_kick_mps;
    return needed_mps && robot.table.speed_for(power) >= *needed_mps;
  };
  double low = robot.table.front().power;
  if (fast_enough(low)) return robot.exit_angle_at(low);
  for (const SetPoint& point : robot.table.set_points()) {
    if (!fast_enough(point.power)) {
      low = point.power;
      continue;
    }
    double high = point.power;
    for (int i = 0; i < kBisections; ++i) (fast_enough(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
    return robot.exit_angle_at(high);
  }
  return robot.exit_angle_at(low);
}

/// The angle of the power that is needed at that angle. Angles of one table differ little, so that power, angle, needed
/// speed and power again settle in a few rounds; where they do not, or no speed reaches, by bisection.
template <typename SpeedsAt>
double matching_angle(const RobotModel& robot, const SpeedsAt& speeds_at) {
  if (!robot.exit_angles) return robot.exit_angle_rad;
  double angle_rad = robot.exit_angle_at(0.5 * (robot.table.front().power + robot.table.back().power));
  for (int i = 0; i < kRounds; ++i) {
    const auto needed_mps = speeds_at(angle_rad).v_kick_mps;
    if (!needed_mps) break;
    const double next_rad = robot.exit_angle_at(robot.table.power_for(*needed_mps).power);
    if (std::abs(next_rad - angle_rad) < 1e-10) return next_rad;
    angle_rad = next_rad;
  }
  return bisected_angle(robot, speeds_at);
}

/// Speeds at the angle of the power that they need.
template <typename SpeedsAt>
void set_speeds(Shot& shot, const RobotModel& robot, const SpeedsAt& speeds_at) {
  shot.exit_angle = matching_angle(robot, speeds_at);
  const Speeds speeds = speeds_at(shot.exit_angle);
  shot.v0_mps = speeds.v0_mps;
  shot.v_kick_mps = speeds.v_kick_mps;
}

/// Power, range and prediction, once the speeds are known.
void set_power(Shot& shot, const RobotModel& robot, const Goal& goal, const PolicyInput& input) {
  if (!shot.v_kick_mps) return;
  const PowerReading reading = robot.table.power_for(*shot.v_kick_mps);
  shot.power = reading.power;
  const KickAction action{.v_kick_mps = robot.table.speed_for(reading.power),
                          .exit_angle = robot.exit_angles ? robot.exit_angle_at(reading.power) : shot.exit_angle,
                          .transfer = robot.transfer_exact,
                          .delay_s = robot.delay_s,
                          .ball_offset_m = robot.ball_offset_m};
  shot.predicted = crossing_of_release(shot.release, input.twist, action, goal.y_m, robot.ball.radius_m);
  shot.too_far = *shot.v_kick_mps > robot.table.back().speed_mps;
  const bool too_strong =
      reading.range == PowerRange::kBelow && !(shot.predicted && shot.predicted->z_m < goal.clean_height_m(robot.ball));
  shot.reachable = !shot.too_far && !too_strong;
}

}  // namespace

Eigen::Vector2d target_on_line(const PolicyConfig& config, const Goal& goal) { return {config.target_x_m, goal.y_m}; }

Eigen::Vector2d target_past(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                            const PolicyInput& input, PossessionMemory& memory) {
  if (!plays_past(config, input)) return target_on_line(config, goal);
  if (memory.corner == 0.0) {
    const auto turn = [&](double side) {
      const Eigen::Vector2d corner{corner_x_m(config, robot, goal, side), goal.y_m};
      return std::abs(wrap_angle(bearing({input.pose.x_m, input.pose.y_m}, corner) - input.pose.heading_rad));
    };
    memory.corner = turn(1.0) < turn(-1.0) ? 1.0 : -1.0;
  }
  return {corner_x_m(config, robot, goal, memory.corner), goal.y_m};
}

Eigen::Vector2d held_ball(const Pose& robot, const RobotModel& model) {
  return to_field(robot, {0.0, model.ball_offset_m});
}

Eigen::Vector2d held_ball(const TurnedPose& robot, const RobotModel& model) {
  return robot.to_field(0.0, model.ball_offset_m);
}

namespace {

Shot shot_at_rest(HeightLaw law, const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                  const PolicyInput& input, const Eigen::Vector2d& target_m) {
  Shot shot;
  shot.release = TurnedPose{advance(input.pose, input.twist, robot.delay_s)};
  shot.distance_m = (target_m - held_ball(input.pose, robot)).norm();
  const FlightPoint target{shot.distance_m, config.target_height_m - robot.ball.radius_m};
  set_speeds(shot, robot, [&](const Elevation& angle) {
    const auto v0_mps = crossing_speed(point_by(law, target, angle), angle);
    return Speeds{v0_mps, v0_mps};
  });
  set_power(shot, robot, goal, input);
  return shot;
}

}  // namespace

Shot stopped_shot(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                  const Eigen::Vector2d& target_m) {
  return shot_at_rest(config.height_law, config, robot, goal, input, target_m);
}

Shot drive_shot(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input) {
  return shot_at_rest(HeightLaw::kExact, config, robot, goal, input, target_on_line(config, goal));
}

Shot moving_shot(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                 const Eigen::Vector2d& target_m) {
  const bool exact = config.motion_law == MotionLaw::kExact;
  Shot shot;
  shot.release = TurnedPose{advance(input.pose, input.twist, robot.delay_s)};
  const Eigen::Vector2d line = target_m - (exact ? held_ball(shot.release, robot) : held_ball(input.pose, robot));
  shot.distance_m = line.norm();
  const FlightPoint target{shot.distance_m, config.target_height_m - robot.ball.radius_m};
  set_speeds(shot, robot, [&](const Elevation& angle) {
    const FlightPoint point = point_by(config.height_law, target, angle);
    Speeds speeds{crossing_speed(point, angle), std::nullopt};
    if (!speeds.v0_mps) return speeds;
    if (exact) {
      const auto aim = aim_exact(point, angle, carry_towards(line, shot.release, robot, input.twist));
      if (aim) speeds.v_kick_mps = aim->v_kick_mps;
    } else {
      const double u_mps = robot.transfer_paper.along_mps(input.twist.vy_mps);
      speeds.v_kick_mps = moving_kick_paper(*speeds.v0_mps, u_mps, angle);
    }
    return speeds;
  });
  set_power(shot, robot, goal, input);
  return shot;
}

}  // namespace trivela::kicking
