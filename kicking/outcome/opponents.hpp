#pragma once

#include <Eigen/Core>

#include <cstddef>

#include "kicking/constants.hpp"
#include "kicking/geometry/goal.hpp"
#include "kicking/outcome/crossing_spread.hpp"

namespace trivela::kicking {

/// How many opponents beside the keeper are looked at.
inline constexpr std::size_t kMostBodies = 5;

/// An opponent that is tracked, in F.
struct BodyPlace {
  Eigen::Vector2d position_m{0.0, 0.0};
  double closing_mps = 0.0;  ///< by which it comes nearer to the ball
  double sd_m = 0.0;         ///< of its position, each axis
};

/// An opponent's body, a cylinder.
struct Body {
  double radius_m = 0.26;  ///< rules: 52 x 52 x 80 cm
  double height_m = 0.8;
};

/// A kick as bodies meet it.
struct KickPath {
  Eigen::Vector2d velocity_mps{0.0, 0.0};  ///< over ground
  double v_z_mps = 0.0;
  double sd_rad = 0.0;  ///< of its direction
};

/// Probability that a body at `relative_m` from the ball at the release, N(., sd^2 per axis), is in the ball's way.
/// With s along the way and u beside it, R = body and ball radius, the ball meets it where |u| < R and s > 0:
///
///     P = Phi((R - u) / sd_u) - Phi((-R - u) / sd_u),   sd_u^2 = sd^2 + (s sd_rad)^2
///
/// but 0 where the ball's lower side is above it at s - R and at s + R, without drag.
double p_in_the_way(const Eigen::Vector2d& relative_m, double sd_m, const KickPath& path, const Body& body,
                    const Ball& ball = {}, double gravity_mps2 = kGravity_mps2);

/// How a keeper is assumed to play: it stands on the goal line until it sees where a ball goes, and drives there.
struct KeeperConfig {
  double reaction_s = 0.25;        ///< it acts on what the ball did so long ago; assumption
  double speed_mps = 2.0;          ///< sideways; Falcons configuration, robot 1 (the keeper)
  double acceleration_mps2 = 4.5;  ///< the same file
  double half_width_m = 0.3;       ///< that stops a ball, a frame that it pushes out included; rules: 0.26 and 0.04 m
  double height_m = 0.85;          ///< the same upwards; rules: 0.8 and 0.1 m
  double sd_m = 0.1;               ///< of where its edge is when the ball comes: how well all of this is known
  double miss_ratio = 0.05;        ///< of the balls within its reach that pass it: its eyes; assumption
  double guess_m = 0.6;            ///< how far one goes that guesses; assumption
  double guess_prior = 0.1;        ///< probability that it guesses, before kicks have shown how it plays; assumption
};

/// A keeper that is tracked.
struct KeeperPlace {
  double x_m = 0.0;      ///< along the goal line, in F
  double sd_m = 0.0;     ///< standard deviation
  bool guesses = false;  ///< as the ball leaves it jumps to a side, whatever the ball does
};

/// How far from its place a keeper still stops a ball that comes to the line after `flight_s` [m], by the ball's
/// centre. tau = flight_s - reaction_s, a is the acceleration, v the speed, h = half_width + ball radius. The keeper
/// drives to where the ball crosses. It stops the ball if it is h or less away by then; W is the farthest such
/// crossing:
///
///     it still speeds up or drives on:  W = h + a tau^2 / 2, from v on h + v (tau - v / (2 a))
///     it brakes, as for its own stop:   T = tau + sqrt(2 h / a),  W = a T^2 / 4 up to T = 2 v / a, then v (T - v / a)
double keeper_reach_m(const KeeperConfig& keeper, double flight_s, const Ball& ball = {});

/// Probabilities of one shot.
struct GoalChance {
  double p_on_target = 0.0;
  double p_goal = 0.0;
};

/// Of a ball whose crossing is spread like that. p_on_target is p_on_target(); a goal is also past the keeper:
/// - beside it: beyond an edge at place +- reach + N(0, sd^2), by three nodes of Gauss and Hermite; sd^2 is the sum of
///   the keeper's and the tracking's variances;
/// - of one that guesses beside where it then is: guess_m to either side alike often, from and to rest;
/// - over it: the ball's lower side is above height_m;
/// - or the keeper misses it, with miss_ratio.
///
/// x and z are independent. Where p_goal is `least` or below both may be 0.
GoalChance goal_chance(const CrossingSpread& crossing, double bounce_ratio, const KeeperConfig& keeper,
                       const KeeperPlace& place, const Goal& goal, const Ball& ball = {}, double least = 0.0);

}  // namespace trivela::kicking
