#include "kicking/policy/moving.hpp"

#include <algorithm>

#include "kicking/alignment/alignment.hpp"
#include "kicking/policy/drive.hpp"
#include "kicking/policy/policy_output.hpp"

namespace trivela::kicking {
namespace {

/// Start of S1 and the two angles, by the configured law.
struct Direction {
  Pose start{};
  double alpha_rad = 0.0;
  double beta_rad = 0.0;
};

Direction expected_direction(const PolicyConfig& config, const RobotModel& robot, const PolicyInput& input,
                             const Shot& shot, double v_kick_mps) {
  const Twist& twist = input.twist;
  if (config.alpha_law == AlphaLaw::kPaperLine) {
    return {input.pose, alpha_paper_rad(twist.vx_mps, robot.alpha_slope_rad_per_mps),
            beta_paper_rad(twist.omega_radps, robot.beta_slope_s)};
  }
  // From the ball's point at the release, with the heading of now: the turn until then is beta's.
  const Eigen::Vector2d ball = held_ball(shot.release, robot);
  return {{ball.x(), ball.y(), input.pose.heading_rad},
          alpha_physical_rad(v_kick_mps, shot.exit_angle, robot.transfer_exact, twist, robot.ball_offset_m),
          twist.omega_radps * (robot.delay_s + 0.5 * config.cycle_s)};
}

}  // namespace

PolicyOutput evaluate_moving(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                             const PolicyInput& input, MovingMemory& memory) {
  const Eigen::Vector2d target = target_past(config, robot, goal, input, memory);
  const Shot shot = moving_shot(config, robot, goal, input, target);
  PolicyOutput output = describe(config, goal, shot);
  output.target_x_m = target.x();
  AlignmentRule rule = config.alignment;
  if (plays_past(config, input)) rule.half_width_m = std::min(rule.half_width_m, config.corner_margin_m);
  const double v_kick_mps = shot.power ? robot.table.speed_for(*shot.power) : robot.table.back().speed_mps;
  const Direction expected = expected_direction(config, robot, input, shot, v_kick_mps);
  output.alpha_rad = expected.alpha_rad;
  output.beta_rad = expected.beta_rad;
  output.alignment() =
      align(expected.start, expected.alpha_rad, expected.beta_rad, input.twist.omega_radps, target, rule);

  const Eigen::Vector2d velocity = dribble_towards(input.pose, target, config, dribble_mps(config, input));
  const double wanted_heading = bearing({expected.start.x_m, expected.start.y_m}, target) + expected.alpha_rad;
  const double error = wrap_angle(wanted_heading - input.pose.heading_rad);
  output.drive = {velocity.x(), velocity.y(), turn_rate_for(error, config.moving_turn_gain_hz, config)};

  const bool extended = std::max(output.left_m, output.right_m) > rule.half_width_m;
  const bool entered = output.aligned && !memory.aligned_before;
  memory.aligned_before = output.aligned;
  if (!shot.reachable) {
    output.reason = Reason::kOutOfRange;
  } else if (!entered && (extended || !output.aligned)) {
    output.reason = Reason::kNotAligned;
  } else {
    output.reason = Reason::kFire;
  }
  return output;
}

}  // namespace trivela::kicking
