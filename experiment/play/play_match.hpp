#pragma once

#include <cstdint>

#include "experiment/play/arm.hpp"
#include "experiment/play/played.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

/// The seed of match `match_id` of an experiment: what `trivela match --seed` plays the same match with. Below 2^52.
std::uint64_t match_seed(std::uint64_t seed, std::uint32_t match_id);

/// Plays one half of `possessions` possessions in this process, without a bus: the world, and the nodes' own logic in
/// the order of a lockstep cycle (docs/architecture.md). The same decisions as `trivela match` with the seed
/// match_seed(seed, match_id), the arm's settings and simulator.max_possessions; but each robot of a team decides with
/// a model and memories of its own, and the policy may be the oracle, which is told the world's true state.
///
/// `record`: gets every message that a log of the match holds; nullptr: nothing is recorded. Throws as
/// check_playable().
PlayedMatch play_match(const sim::Scenario& scenario, const Arm& arm, std::uint64_t seed, std::uint32_t match_id,
                       std::uint32_t possessions, const PlayOptions& options = {}, MatchRecord* record = nullptr);

/// The same with the match's own seed, as `trivela match --seed`. An old table is drawn as for match 0 of `seed`.
PlayedMatch play_seeded_match(const sim::Scenario& scenario, const Arm& arm, std::uint64_t seed,
                              std::uint32_t possessions, const PlayOptions& options = {},
                              MatchRecord* record = nullptr);

}  // namespace trivela::experiment
