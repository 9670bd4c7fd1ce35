#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kicking/geometry/frames.hpp"
#include "kicking/random/draws.hpp"
#include "sim/scenario.hpp"

namespace trivela::sim {

/// An opponent as play starts.
struct OpponentStart {
  double distance_m = 0.0;   ///< from the ball
  double bearing_rad = 0.0;  ///< from the ball, counter-clockwise from +y of F, any direction alike
  double closing_mps = 0.0;
};

inline constexpr std::size_t kMostOpponents = 5;

/// The situation in which a robot gains the ball.
struct Opportunity {
  std::uint8_t robot = 1;   ///< which of ours, counted from 1
  kicking::Pose start;      ///< robot in F
  kicking::Twist velocity;  ///< in R, when play starts; it does not turn
  std::size_t opponent_count = 1;
  std::array<OpponentStart, kMostOpponents> opponents{};  ///< the nearest one first
  /// From the start of play until the referee stops it, if the robot has the ball until then.
  double whistle_s = std::numeric_limits<double>::infinity();
};

/// Draws an opportunity from the scenario's distributions:
/// ball x ~ U(-lateral, lateral), goal distance ~ U(min, max), heading = bearing of the goal centre + N(0, aim),
/// speed ~ U(min, max), its direction = heading + N(0, travel), ln(opponent distance) ~ N(ln median, sigma), the robot
/// any of the team alike, whistle ~ Exp(stops_per_min).
Opportunity draw_opportunity(const Scenario& scenario, const kicking::Draws& draws);

}  // namespace trivela::sim
