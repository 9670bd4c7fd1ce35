#pragma once

#include <cstdint>
#include <optional>

#include "nodes/in_process/arm.hpp"
#include "nodes/in_process/match_record.hpp"
#include "nodes/in_process/played.hpp"
#include "sim/scenario.hpp"

namespace trivela::nodes {

/// The seed of match `match_id` of an experiment: what `trivela match --seed` plays the same match with. Below 2^52.
std::uint64_t match_seed(std::uint64_t seed, std::uint32_t match_id);

/// What is recorded beside the possessions.
struct PlayOptions {
  bool shadows = false;      ///< the policies that are not in charge judge as well
  bool every_cycle = false;  ///< record every decision, not only those that fire
};

/// The arm's settings as its robots play by them, but for kick_decision.assignment_seed, which is the match's.
config::Settings settings_of(const Arm& arm, const PlayOptions& options);

/// How many of our robots play.
std::uint8_t team_size(const sim::Scenario& scenario);

/// What a robot, counted from 1, knows of itself in a match of this arm. Throws std::invalid_argument where the old
/// table that is drawn for it cannot be used: no ball reaches the target's height from one of its distances.
config::Robot robot_of(const sim::Scenario& scenario, const Arm& arm, std::uint64_t seed, std::uint32_t match_id,
                       std::uint8_t robot_id);

/// The policy of all possessions of a match, where it is one and the same for every robot of the team.
std::optional<kicking::PolicyName> only_policy(const sim::Scenario& scenario, const Arm& arm);

/// Throws std::runtime_error in a sentence that names the arm, where play_match() could not play it: for a scenario
/// that sim::first_problem() refuses or whose cycle is not the settings', no possessions, no robot, a table that is
/// none, and policies that make no sense together.
void check_playable(const sim::Scenario& scenario, const Arm& arm, std::uint32_t possessions);

/// Plays one half of `possessions` possessions in this process, without a bus: the world, and the nodes' own logic in
/// the order of a lockstep cycle (docs/architecture.md). The same decisions as `trivela match` with the seed
/// match_seed(seed, match_id), the arm's settings and simulator.max_possessions; but each robot of a team decides with
/// a model and memories of its own, and the policy may be the oracle, which is told the world's true state.
///
/// `record`: gets every message that a log of the match holds; nullptr: nothing is recorded. Throws as
/// check_playable().
PlayedMatch play_match(const sim::Scenario& scenario, const Arm& arm, std::uint64_t seed, std::uint32_t match_id,
                       std::uint32_t possessions, const PlayOptions& options = {}, MatchRecord* record = nullptr);

}  // namespace trivela::nodes
