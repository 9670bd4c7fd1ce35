#pragma once

#include "kicking/geometry/frames.hpp"
#include "sim/random.hpp"
#include "sim/scenario.hpp"

namespace trivela::sim {

/// The situation in which the robot gains the ball.
struct Opportunity {
  kicking::Pose start;                ///< robot in F
  kicking::Twist velocity;            ///< in R, when play starts; it does not turn
  double opponent_distance_m = 0.0;   ///< from the ball
  double opponent_bearing_rad = 0.0;  ///< from the ball, counter-clockwise from +y of F, any direction alike
  double opponent_closing_mps = 0.0;
};

/// Draws an opportunity from the scenario's distributions:
/// ball x ~ U(-lateral, lateral), goal distance ~ U(min, max), heading = bearing of the goal centre + N(0, aim),
/// speed ~ U(min, max), its direction = heading + N(0, travel), ln(opponent distance) ~ N(ln median, sigma).
Opportunity draw_opportunity(const Scenario& scenario, const Draws& draws);

}  // namespace trivela::sim
