#pragma once

#include "kicking/policy/policy.hpp"

/// Whether a robot shall kick now, and how hard: four nouns, a robot, a goal, a state and an output, and `evaluate`
/// that makes the fourth of the other three. SI units; the field's origin is its centre spot, +y points to the
/// opponents' goal, +x to the right, and a heading of 0 faces the goal. Everything is a value, and nothing is
/// allocated.
///
///     const trivela::RobotModel robot;
///     const trivela::Goal goal{.y_m = 9.0};
///     trivela::State state;
///     state.pose = {.x_m = 0.5, .y_m = 4.0, .heading_rad = 0.1};
///     state.playing = state.possession = state.kicker_ready = true;
///     const trivela::PolicyOutput output = trivela::evaluate(robot, goal, state);
///
/// examples/solve_a_kick.cpp is this as a program. What kicking/ holds besides, a program includes by its own name.
namespace trivela {

using kicking::Goal;
using kicking::PolicyOutput;
using kicking::RobotModel;

/// What one instant knows: where the robot is and how it moves, and whether the game runs, it has the ball and the
/// kicker is ready, which are false until they are said: then it holds.
using State = kicking::PolicyInput;

using kicking::PolicyConfig;
using kicking::PolicyMemory;
using kicking::PolicyName;

/// Fire or hold in each cycle of a match: the memory is the policy's own and goes from call to call.
using kicking::evaluate;

/// The same of an instant by itself, which nothing went before; who judges comes last, since there is a usual one.
inline PolicyOutput evaluate(const RobotModel& robot, const Goal& goal, const State& state,
                             PolicyName policy = PolicyName::kMoving, const PolicyConfig& config = {}) {
  PolicyMemory nothing;
  return evaluate(policy, config, robot, goal, state, nothing);
}

}  // namespace trivela
