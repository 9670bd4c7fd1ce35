#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "experiment/play/match_record.hpp"
#include "experiment/play/played.hpp"
#include "experiment/run/experiment.hpp"

namespace trivela::experiment {

/// One arm's match as it was played.
struct ArmMatch {
  PlayedMatch played;
  MatchRecord record;        ///< empty where nothing is recorded
  double processor_s = 0.0;  ///< of the thread that played it
};

/// Gets the match of every arm.
using TakeMatch = std::function<void(std::uint32_t match_id, const std::vector<ArmMatch>& arms)>;

/// Plays the matches of the plan's range from `first` on with `jobs` threads. `take` gets them in the order of their
/// numbers, whatever order they are played in: one call at a time, by any of the threads, while the others play on.
/// False: watch.stop asked to stop. Rethrows what `take` and the watch throw.
bool play_matches(const ExperimentPlan& plan, std::uint32_t first, unsigned jobs, bool recorded,
                  const ExperimentWatch& watch, const TakeMatch& take);

}  // namespace trivela::experiment
