#pragma once

#include <optional>
#include <span>

#include "config/settings.hpp"
#include "kicking/geometry/goal.hpp"
#include "kicking/outcome/outcome.hpp"
#include "nodes/shot_observer/flight_fit.hpp"

namespace trivela::nodes {

/// What the sightings of a shot say about it.
struct ShotVerdict {
  kicking::Outcome outcome = kicking::Outcome::kUnknown;
  std::optional<double> x_cross_m;  ///< ball centre at the goal line, in F
  std::optional<double> z_cross_m;
  std::optional<double> sd_cross_m;
  std::optional<double> exit_speed_mps;  ///< over ground, of the first sightings
  std::optional<double> exit_elevation_rad;
};

/// How the sightings ended.
enum class FlightEnd {
  kBeyondLine,  ///< the ball is behind the goal line
  kThrownBack,  ///< it came back from the plane of the goal: post or bar
  kAtRest,      ///< it lies, or time is up
  kTakenAway,   ///< the referee stopped the game, or the ball is suddenly elsewhere
  kLost         ///< no sighting for too long
};

/// Judges a shot from its sightings alone, `expected_speed_mps` being the horizontal speed that the kick should have
/// had.
///
/// A ball that turned aside in the air or lost its speed there was blocked, and so was one that was taken away while it
/// moved. Otherwise the flight after the last bounce
/// is fitted over the last `fit_frames` sightings before the line; where it meets y = goal.y_m decides. A ball that
/// came back from the plane hit the frame: of post and bar the nearer one.
ShotVerdict judge_shot(std::span<const Sighting> sightings, FlightEnd end, double expected_speed_mps,
                       const kicking::Goal& goal, const config::ShotObserver& settings);

}  // namespace trivela::nodes
