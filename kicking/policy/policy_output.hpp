#pragma once

#include <algorithm>
#include <limits>

#include "kicking/geometry/time.hpp"
#include "kicking/policy/rule.hpp"
#include "kicking/policy/shot.hpp"

namespace trivela::kicking {

/// An output with the target and the numbers of the shot; nothing decided yet.
inline PolicyOutput describe(const PolicyConfig& config, const Goal& goal, const ShotNumbers& shot) {
  PolicyOutput output;
  output.target_x_m = config.target_x_m;
  output.target_y_m = goal.y_m;
  output.target_z_m = config.target_height_m;
  output.shot() = shot;
  return output;
}

/// Whether a kick is for a goal past a keeper.
inline bool weighs_keeper(const PolicyConfig& config, const PolicyInput& input) {
  return config.objective == Objective::kGoal && input.keeper;
}

/// Whether it is aimed at a corner, since the keeper stays in the middle.
inline bool plays_past(const PolicyConfig& config, const PolicyInput& input) {
  return weighs_keeper(config, input) && !input.keeper->guesses;
}

/// Speed over ground towards the goal.
inline double dribble_mps(const PolicyConfig& config, const PolicyInput& input) {
  return plays_past(config, input) ? config.goal_dribble_mps : config.dribble_mps;
}

/// Where a kick into a corner is aimed along the goal line, in F [m]: side -1 left, 1 right.
inline double corner_x_m(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, double side) {
  return side * std::max(0.0, goal.clean_half_width_m(robot.ball) - config.corner_margin_m);
}

/// How far the robot may still go with the ball that it took at memory.taken_m. However it turns, the ball is at most
/// ball_offset_m farther from there than its centre: radius = carry_limit_m - carry_margin_m - ball_offset_m.
inline DribbleLimit carry_reach(const PolicyConfig& config, const RobotModel& robot, const PossessionMemory& memory) {
  if (!memory.taken_m) return {};
  const double radius_m = config.rules.carry_limit_m - config.carry_margin_m - robot.ball_offset_m;
  return {radius_m, config.max_brake_mps2, *memory.taken_m};
}

/// May a ball with its centre at ball_y_m of F be kicked at the goal?
inline bool may_shoot_from(const PolicyConfig& config, double ball_y_m) {
  return !config.rules.opponents_half_only || ball_y_m > config.half_line_margin_m;
}

/// The same of the ball that is held, now and where an order that goes out now releases it.
inline bool may_shoot(const PolicyConfig& config, const RobotModel& robot, const PolicyInput& input,
                      const PolicyOutput& output) {
  if (!config.rules.opponents_half_only) return true;
  return may_shoot_from(config, held_ball(input.pose, robot).y()) &&
         (!output.predicted || may_shoot_from(config, output.predicted->release_m.y()));
}

/// The last instant of a coil that takes our set piece in time [s from now]; infinite where there is none to take, or
/// none that could still be taken in time.
inline double last_fire_after_s(const RobotModel& robot, const PolicyInput& input) {
  const double last_s = input.set_piece_left_s.value_or(-1.0) - robot.delay_s;
  return last_s >= 0.0 ? last_s : std::numeric_limits<double>::infinity();
}

/// Does an order of this possession still have its time?
inline bool order_pending(const PolicyConfig& config, const PolicyInput& input, const PossessionMemory& memory) {
  return memory.fired_t_ns && seconds(input.t_ns - *memory.fired_t_ns) < config.order_hold_s;
}

}  // namespace trivela::kicking
