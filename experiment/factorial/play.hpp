#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "experiment/effects/effects.hpp"
#include "experiment/run/evening_arms.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

/// How much is played.
struct PlayPlan {
  std::uint64_t seed = 1;
  std::uint32_t matches = 400;
  std::uint32_t possessions = 45;  ///< a match
  unsigned jobs = 1;               ///< threads
  /// Robots as evenings of calibration left them; match m is played with those of evening m mod their number, in every
  /// arm but one that has robots of its own. Empty: each arm's robots.
  std::vector<Team> evenings{};
};

/// A match of an arm, by their numbers.
struct ArmMatch {
  std::size_t arm = 0;
  std::uint32_t match = 0;
};

/// Plays these matches; `played(match, tally)` is called from one thread at a time, as they end; where it throws,
/// nothing more is begun or reported. Rethrows what it or a match throws.
void play_matches(const sim::Scenario& scenario, const std::vector<Arm>& arms, const PlayPlan& plan,
                  const std::vector<ArmMatch>& matches,
                  const std::function<void(const ArmMatch&, const MatchTally&)>& played);

/// Plays every match with every arm, on the same opportunities: result[arm][match]. The same answer for any number of
/// jobs. `progress(done, all)` is called from one thread at a time, as matches end; where it throws, nothing more is
/// played. Rethrows what it or a match throws.
std::vector<std::vector<MatchTally>> play_arms(const sim::Scenario& scenario, const std::vector<Arm>& arms,
                                               const PlayPlan& plan,
                                               const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace trivela::experiment
