#pragma once

#include <cstdint>
#include <memory>

#include "sim/commands.hpp"
#include "sim/scenario.hpp"
#include "sim/sensors.hpp"
#include "sim/truth.hpp"

namespace trivela::sim {

/// A match against the opponents, half after half, one possession of the ball after another, each gained by one of our
/// robots.
///
/// A possession: the referee stops the game for `possession.stop_s`, the robot stands at the drawn pose with the ball
/// in its handler; then play starts and the robot has the drawn velocity at once (it gained the ball on the run). It
/// ends with a kick (when the ball crossed, was blocked, came to rest or flew for `flight_limit_s`), with a dispute
/// (an opponent is at the ball), with the referee's whistle or with the time limit, which a ball carried over a field
/// line counts as. A coil
/// energised before the end of a possession wins: its ball leaves first. With `referee.set_pieces` the robot does not
/// gain the ball on the run: each possession is a set piece of ours, announced in its stop, and the referee whistles
/// where it is not taken in time.
///
/// Possession n of a half depends on (seed, half, n) alone, so that every policy meets the same poses, opponents and
/// noise: the draws of one role never shift another's. Each half has possessions of its own, unless the halves are
/// paired: then possession n is the same situation in all of them. Between steps the world stands still; the same seed
/// and the same commands give the same bits.
///
///     while (!match.done()) { publish(match.sense()); report(match.step(commands)); }
class Match {
 public:
  /// `halves` halves of `half_minutes` minutes each, or of `max_possessions` possessions if those are over first (0: no
  /// such limit); a half ends with the possession under way and one more stop, after which the observers have seen
  /// everything. `paired_halves`: every half has the possessions of the first. Throws std::runtime_error naming key and
  /// value for a scenario that first_problem() refuses, fewer than 1 or more than 255 halves, or a duration that is not
  /// positive.
  Match(const Scenario& scenario, std::uint64_t seed, int halves, double half_minutes,
        std::uint32_t max_possessions = 0, bool paired_halves = false);
  ~Match();
  Match(Match&&) noexcept;
  Match& operator=(Match&&) noexcept;

  /// True after the last step of the last half.
  bool done() const;

  /// What the sensors and the referee say now; samples that are not looked for are left at their defaults.
  Sensors sense(const SensorChoice& choice = {}) const;

  /// The kicker of one of our robots, counted from 1, as it is in this match. For the oracle and for tests alone.
  Kicker true_kicker(std::uint32_t robot) const;

  /// The world as it is, without noise. For the oracle and for tests alone.
  TrueState true_state() const;

  /// Plays one cycle: the base follows `commands.drive` from now on, a fire energises the coil at its instant, at once
  /// if that has passed. A drive set-point that is not finite is one of zero: the robot brakes. A fire is ignored if
  /// its power is not finite or while a kick is under way. Without a ball in the handler, or while the referee has
  /// stopped the game, it drains the capacitor and has no KickTruth. Must not be called when done().
  StepEvents step(const Commands& commands);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trivela::sim
