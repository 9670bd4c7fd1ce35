#pragma once

#include <optional>
#include <vector>

#include "robot/observer/flight_filter.hpp"
#include "robot/observer/shot_judge.hpp"

namespace trivela::robot {

/// Where and when a free ball meets the plane of the goal.
struct PlaneCrossing {
  double t_s = 0.0;  ///< since the release
  double sd_t_s = 0.0;
  double x_m = 0.0, sd_x_m = 0.0;
  double z_m = 0.0, sd_z_m = 0.0;
  FlightFilter ball;  ///< there
};

/// A turn by an opponent between two sightings, against free flight: ln of its likelihood for what was seen before the
/// line and after it, less that of free flight before the line.
struct Turn {
  double within_s = 0.0;  ///< how long it may have happened
  double log_likelihood = 0.0;
  std::optional<PlaneCrossing> crossing{};  ///< where the ball was to cross, of a turn near the goal line
};

/// How often an opponent turns a kick on its way, before anything is seen; assumption.
inline constexpr double kTurned = 0.05;

/// A keeper plays so far before its line, its body included; assumption: nearer than defenders, who keep out of the
/// goal area of 0.75 m.
inline constexpr double kKeeperDepth_m = 0.75;

/// The sightings as free flight explains them, and as other hypotheses do.
struct FlightHypotheses {
  std::optional<PlaneCrossing> crossing;
  bool seen_after_crossing = false;
  double log_passed = 0.0;       ///< ln of the likelihood of what was seen after the crossing, if the ball flew on
  double log_thrown_back = 0.0;  ///< the same, if it was thrown back there
  std::vector<Turn> turns;
  FlightFilter last;      ///< at the last sighting before the line
  double last_t_s = 0.0;  ///< its time
  double residual_sd_m = 0.0;
};

/// none: fewer than three sightings of the flight itself.
std::optional<FlightHypotheses> flight_hypotheses(const ShotTrack& track, double goal_y_m);

}  // namespace trivela::robot
