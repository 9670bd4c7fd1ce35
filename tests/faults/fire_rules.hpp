#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/faults/testimony.hpp"

namespace trivela::faults {

/// What a fire may be judged for.
enum class Offence {
  kNoOrder,       ///< nobody saw an order of this id
  kUnauthorised,  ///< its order was an unauthorised client's
  kStale,         ///< its order was too old, or no longer valid
  kTwice,         ///< this id was fired before
  kStopped,       ///< the referee had stopped the game
  kSilent,        ///< the referee had said nothing for long
  kTooSoon,       ///< after the fire before it
  kCarriedLate,   ///< the device kicked long after the order
};

/// How the offence stands in a table.
const char* name(Offence offence);

/// A fire that should not have been.
struct Finding {
  Offence offence = Offence::kNoOrder;
  FireSeen fire;
  std::string why;  ///< with the numbers
};

struct FireRules {
  std::int64_t max_age_ns = 100'000'000;        ///< of an order when it is fired
  std::int64_t max_silence_ns = 1'000'000'000;  ///< of the referee
  std::int64_t min_interval_ns = 500'000'000;   ///< between two fires
  /// Allowed to an arrival, since a busy machine may keep a process waiting between its look at the clock and its word:
  /// one cycle. Nothing is allowed to a t_ns.
  std::int64_t margin_ns = 20'000'000;
  /// Most from the order to the release of the ball that the device may add: its delay of 60 ms with its spread, and
  /// the cycle in which it takes the order in.
  std::int64_t release_delay_ns = 250'000'000;
  /// Every t_ns is CLOCK_MONOTONIC. Otherwise age and interval are judged by arrivals alone.
  bool steady_t_ns = true;
};

/// Judges every fire that was not called off in time. `device` is who hears what the driver hears and gives, on its own
/// cable: its fires are judged by its referee's words. `wire` hears everybody, on a cable that no fault touches: an
/// order or a fire counts that either of them saw.
std::vector<Finding> judge(const Testimony& device, const Testimony& wire, const FireRules& rules);

/// The fires that either saw, by arrival, without those that were called off before their instant.
std::vector<FireSeen> fires_carried_out(const Testimony& device, const Testimony& wire, const FireRules& rules);

}  // namespace trivela::faults
