#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cli/factorial/effects.hpp"
#include "nodes/in_process/arm.hpp"
#include "sim/scenario.hpp"

namespace trivela::cli {

/// How much is played.
struct PlayPlan {
  std::uint64_t seed = 1;
  std::uint32_t matches = 400;
  std::uint32_t possessions = 45;  ///< a match
  unsigned jobs = 1;               ///< threads
};

/// Plays every match with every arm, on the same opportunities: result[arm][match]. The same answer for any number of
/// jobs. `progress(done, all)` is called from one thread at a time, as matches end. Rethrows what a match throws.
std::vector<std::vector<MatchTally>> play_arms(const sim::Scenario& scenario, const std::vector<nodes::Arm>& arms,
                                               const PlayPlan& plan,
                                               const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace trivela::cli
