#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "config/settings.hpp"
#include "kicking/ballistics/flight.hpp"
#include "kicking/geometry/goal.hpp"
#include "kicking/optional_double.hpp"
#include "kicking/outcome/outcome.hpp"

namespace trivela::robot {

/// The drag-free parabola through a flight, from the floor to the goal line or to its first bounce: least squares over
/// all of it, so that its speed and elevation are what a table of effective speeds has.
struct FlightParabola {
  double speed_mps = 0.0;      ///< where it leaves the floor
  double elevation_rad = 0.0;  ///< the same
  double direction_rad = 0.0;  ///< heading in F
  double sd_mps = 0.0;         ///< standard deviation of a component of the velocity
};

/// What the sightings of a shot say about it.
struct ShotVerdict {
  kicking::Outcome outcome = kicking::Outcome::kUnknown;
  std::optional<kicking::OutcomeProbabilities> probabilities;  ///< none: not computed
  kicking::OptionalDouble x_cross_m;                           ///< ball centre at the goal line, in F
  kicking::OptionalDouble z_cross_m;
  kicking::OptionalDouble sd_cross_m;      ///< the larger one of both
  kicking::OptionalDouble exit_speed_mps;  ///< over ground, of the first sightings
  kicking::OptionalDouble exit_elevation_rad;
  std::optional<FlightParabola> parabola;  ///< none: it was touched on its way, or not seen long enough
  bool bounced = false;                    ///< it touched the floor before the line, or before it was seen last
  kicking::OptionalDouble residual_sd_m;
  kicking::OptionalDouble release_late_s;  ///< after release_t_ns of the track, by the flight
  kicking::OptionalDouble p_saved;  ///< probability that it was on target and a keeper stopped it; none: not computed
};

/// How the sightings ended.
enum class FlightEnd {
  kBeyondLine,  ///< the ball is behind the goal line
  kThrownBack,  ///< it came back from the plane of the goal
  kAtRest,      ///< it lies, or time is up
  kTakenAway,   ///< the referee stopped the game, or the ball is suddenly elsewhere
  kLost         ///< no sighting for too long
};

/// A kick as it was expected and as it was seen.
struct ShotTrack {
  std::span<const kicking::Sighting> sightings;  ///< from the expected release on
  FlightEnd end{};
  std::int64_t release_t_ns = 0;
  std::int64_t end_t_ns = 0;                     ///< when it was over; the last sighting or later
  double expected_speed_mps = 0.0;               ///< over ground, that the kick should have given
  kicking::OptionalDouble expected_climb_mps{};  ///< the same upwards; none: not known
  double ball_sd_m = 0.03;                       ///< of a sighting
  double save_ratio = 0.005;                     ///< of the balls between posts and bar: a keeper stops them
};

/// Weighs the outcomes by their likelihood in the light of the sightings:
///
///     free flight to the line (FlightFilter), there clean or past the frame: it flies on; post or bar: it comes back
///     (a keeper's save, as often as save_ratio); free flight and rest: short; somebody turned it between two
///     sightings: blocked, or within kKeeperDepth_m of the line, where it was to cross on target, a keeper's save.
///
/// Where the crossing may lie is a normal distribution over the regions of classify(); what followed the crossing
/// decides between the regions that let a ball pass and those that throw it back. The likeliest outcome is given where
/// its probability is at least `label_probability`, otherwise kUnknown; fewer than five sightings tell of kBlocked and
/// of nothing else. A ball that flew freely up to the referee's stop before the line is kUnknown, too: nothing was seen
/// that stopped it. What is left of 1 of the probabilities is just that.
ShotVerdict judge_shot(const ShotTrack& track, const kicking::Goal& goal, const config::ShotObserver& settings);

}  // namespace trivela::robot
