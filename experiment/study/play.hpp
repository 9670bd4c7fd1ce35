#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/run/calibrations.hpp"
#include "experiment/study/study.hpp"
#include "log/shards/shards.hpp"
#include "log/shards/study_results.hpp"

namespace trivela::experiment {

/// How much is played.
struct PlayPlan {
  std::uint64_t seed = 1;
  std::uint32_t matches = 400;
  std::uint32_t possessions = 45;  ///< a match
  unsigned jobs = 1;               ///< threads
  /// Teams as calibrations left them. Match m is played with team m mod their number, in every arm but one that has
  /// robots of its own. Empty: each arm's robots.
  std::vector<Team> calibrations{};
  std::optional<log::Shard> shard{};  ///< whose share of the matches is played; none: all of them
};

/// What is known of the arms.
struct KnownPlay {
  std::vector<StudyRow> rows;  ///< by world and arm; a match that is not known is empty
  bool whole = false;          ///< every match of every arm is known
};

/// Plays the matches of the plan that `results` do not have, and keeps them there; arms have the name "what: NAME". All
/// arms of a match meet the same opportunities. The rows do not depend on the number of threads. `progress(done, all,
/// what)`, of what is to be played, is called before the first match, then by one thread at a time; where it throws,
/// nothing more is played or reported. Rethrows what it or a match throws.
KnownPlay play_missing(const std::vector<StudyWorld>& worlds, const PlayPlan& plan, log::StudyResults& results,
                       const std::function<void(std::size_t done, std::size_t all, const std::string& what)>& progress);

}  // namespace trivela::experiment
