#pragma once

#include "kicking/constants.hpp"
#include "kicking/geometry/goal.hpp"
#include "kicking/outcome/crossing_spread.hpp"

namespace trivela::kicking {

/// How a keeper is assumed to play: it stands on the goal line until it sees where a ball goes, and drives there.
struct KeeperConfig {
  double reaction_s = 0.25;        ///< it acts on what the ball did so long ago; assumption
  double speed_mps = 2.0;          ///< sideways; Falcons configuration, robot 1 (the keeper)
  double acceleration_mps2 = 4.5;  ///< the same file
  double half_width_m = 0.3;       ///< that stops a ball, a frame that it pushes out included; rules: 0.26 and 0.04 m
  double height_m = 0.85;          ///< the same upwards; rules: 0.8 and 0.1 m
  double sd_m = 0.1;               ///< of where its edge is when the ball comes: how well all of this is known
  double miss_ratio = 0.05;        ///< of the balls within its reach that pass it: its eyes; assumption
};

/// A keeper that is tracked.
struct KeeperPlace {
  double x_m = 0.0;   ///< along the goal line, in F
  double sd_m = 0.0;  ///< standard deviation
};

/// How far from where it stood a keeper has a ball that comes to the line after `flight_s`, measured at the ball's
/// centre [m]. With tau = flight_s - reaction_s, the acceleration a, the speed v and h = half_width + ball radius, it
/// has the greatest W whose end is h or less away when the ball is there:
///
///     it still speeds up or drives on:  W = h + a tau^2 / 2, from v on h + v (tau - v / (2 a))
///     it brakes, as for its own stop:   T = tau + sqrt(2 h / a),  W = a T^2 / 4 up to T = 2 v / a, then v (T - v / a)
double keeper_reach_m(const KeeperConfig& keeper, double flight_s, const Ball& ball = {});

/// Probabilities of one shot.
struct GoalChance {
  double p_on_target = 0.0;
  double p_goal = 0.0;
};

/// Of a ball whose crossing is spread like that: p_on_target(), and that it is not the keeper's, either. It passes
/// beside an edge at place +- reach + N(0, sd^2), in which the keeper's and the tracking's errors are one (three nodes
/// of Gauss and Hermite), or over it where its lower side is above height_m; of the others the keeper misses a share. x
/// and z are independent.
GoalChance goal_chance(const CrossingSpread& crossing, double bounce_ratio, const KeeperConfig& keeper,
                       const KeeperPlace& place, const Goal& goal, const Ball& ball = {});

}  // namespace trivela::kicking
