#pragma once

#include <optional>

#include "sim/scenario.hpp"
#include "sim/truth.hpp"

namespace trivela::sim {

/// What a guard mistakes about one kick, in its standard deviations: sideways and upwards.
struct Misjudgement {
  double sideways = 0.0;
  double upwards = 0.0;
  std::optional<double> guessed_m{};  ///< where it drives as the ball leaves, whatever the ball does; none: it looks
};

/// A guard's frame, pushed out to one side or up. All 0: it has none.
struct Extension {
  double side_m = 0.0;
  double up_m = 0.0;
  double out_s = 0.0;  ///< until it is out
};

/// A ball that crosses a guard's line.
struct GuardedBall {
  Crossing crossing;     ///< true
  double flown_s = 0.0;  ///< from the release to there
  double radius_m = 0.11;
};

/// Where the guard's middle is along its line when the ball crosses it [m].
///   It knows at t what the ball showed at s = t - reaction_s, from s = 0 on: that it will cross at
///   x + sight_sd_mps N (T - s), T the time of flight; the error shrinks as the ball comes near.
///   It drives there from rest at `start_x_m` within speed and acceleration, braking in time. Steps of 2 ms.
double guard_place_m(const Guard& guard, double start_x_m, const GuardedBall& ball, const Misjudgement& misjudged);

/// A guard on its way along its line.
struct GuardMotion {
  double x_m = 0.0;
  double v_mps = 0.0;
  double t_s = 0.0;  ///< since it left
};

/// Where a guard is that drives to `aim_m` at once, `until_s` after it left [m]: guard_place_m() of one that guesses.
/// `jump` goes on by whole steps, so that a later instant begins there; it must not be past `until_s`.
double jumped_place_m(const Guard& guard, double aim_m, double until_s, GuardMotion& jump);

/// Whether the guard stops the ball: both overlap by `overlap_m` in width and in height. A frame goes up where the ball
/// is taken to pass over the body when it must be decided (`out_s` before the crossing), else to the side where the
/// ball is taken to pass.
bool guard_stops(const Guard& guard, const Extension& extension, double start_x_m, const GuardedBall& ball,
                 const Misjudgement& misjudged);

}  // namespace trivela::sim
