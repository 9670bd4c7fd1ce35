#pragma once

#include <functional>
#include <vector>

#include "sim/match.hpp"

namespace trivela::sim {

using Policy = std::function<Commands(const Sensors&)>;

/// Everything that a match said.
struct Record {
  std::vector<Sensors> sensors;
  std::vector<KickTruth> kicks;
  std::vector<PossessionTruth> possessions;
};

inline Record play(const Scenario& scenario, std::uint64_t seed, int halves, double minutes, const Policy& policy,
                   bool paired_halves = false) {
  Match match{scenario, seed, halves, minutes, 0, paired_halves};
  Record record;
  while (!match.done()) {
    record.sensors.push_back(match.sense());
    const StepEvents events = match.step(policy(record.sensors.back()));
    record.kicks.insert(record.kicks.end(), events.kicks.begin(), events.kicks.end());
    record.possessions.insert(record.possessions.end(), events.possessions.begin(), events.possessions.end());
  }
  return record;
}

inline Commands idle(const Sensors&) { return {}; }

/// Drives on and fires in the first cycle of each possession.
inline Policy fire_at_once(double power) {
  return [power, last = std::uint32_t{0}](const Sensors& s) mutable {
    Commands commands{.drive = {0.2, 1.0, 0.3}, .fire = {}};
    if (s.referee.playing && s.referee.possession_id != last) {
      last = s.referee.possession_id;
      commands.fire = Fire{s.t_ns, static_cast<std::int64_t>(1000 + last), power};
    }
    return commands;
  };
}

/// Nobody disturbs, the referee neither.
inline Scenario alone() {
  Scenario s;
  s.referee.stops_per_min = 0.0;
  s.opponent.distance_median_m = 50.0;
  s.opponent.distance_sigma_ln = 0.0;
  return s;
}

}  // namespace trivela::sim
