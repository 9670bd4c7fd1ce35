#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "experiment/play/arm.hpp"
#include "idl/messages.hpp"
#include "kicking/optional_double.hpp"
#include "kicking/outcome/outcome.hpp"
#include "kicking/policy/policy.hpp"
#include "sim/scenario.hpp"
#include "sim/truth.hpp"

namespace trivela::experiment {

/// A kick of a possession: what the robot believed when it ordered it, and what became of it.
struct PlayedKick {
  double distance_m = 0.0;  ///< ball centre to target, horizontal
  double vx_mps = 0.0;      ///< twist in R
  double vy_mps = 0.0;
  double omega_radps = 0.0;
  kicking::OptionalDouble opponent_distance_m;  ///< of the nearest opponent from the ball
  double power = 0.0;
  std::uint8_t kind = 0;  ///< of the robot's kinds of kick
  double v_kick_mps = 0.0;
  kicking::OptionalDouble p_on_target;                     ///< predicted
  std::optional<kicking::PredictedCrossing> predicted;     ///< crossing of the goal line
  kicking::Outcome observed = kicking::Outcome::kUnknown;  ///< by the shot observer
  std::optional<kicking::Outcome> truth;                   ///< of the simulator; none: the ball never left
  bool truth_saved = false;                                ///< of the simulator: the keeper had it
  bool truth_bounced = false;                              ///< of the simulator: it touched the floor before that
};

/// One opportunity: a possession of the ball by one of our robots.
struct PlayedPossession {
  std::uint32_t match_id = 0;
  std::uint32_t possession_id = 0;
  std::uint8_t robot_id = 1;
  kicking::PolicyName policy{};         ///< in charge
  double assignment_probability = 1.0;  ///< with which it was put in charge
  sim::PossessionEnd ending{};
  double played_s = 0.0;           ///< of play, until the next stop
  double start_distance_m = 0.0;   ///< ball centre to the middle of the goal line at the start, true
  std::optional<PlayedKick> kick;  ///< the last accepted one
};

/// The possessions of a match in their order. The n-th of two arms with the same seed and match_id are the same
/// situation with the same noise.
struct PlayedMatch {
  std::uint64_t match_seed = 0;  ///< that `trivela match --seed` plays the same match with
  std::int64_t end_t_ns = 0;
  std::uint64_t cycles = 0;
  std::vector<PlayedPossession> possessions;
};

/// Who was in charge of a possession, and with which probability. The possession is the robot's own count.
struct Assignment {
  std::uint8_t robot_id = 1;
  std::uint8_t half = 1;
  std::uint32_t possession_id = 0;
  kicking::PolicyName policy{};
  double probability = 1.0;
  std::int64_t t_ns = 0;  ///< the first decision of it in play
};

/// The messages of a match that a log of it holds, in the order of their sequence numbers.
struct MatchRecord {
  std::vector<msg::Referee> referee;  ///< where its command changes
  std::vector<msg::KickDecision> decisions;
  std::vector<msg::KickOrder> orders;
  std::vector<msg::KickReceipt> receipts;
  std::vector<msg::KickOutcome> outcomes;
  std::vector<msg::KickerEstimate> estimates;
  std::vector<msg::KickTruth> kick_truths;
  std::vector<msg::PossessionTruth> possession_truths;
  std::vector<Assignment> assignments;
};

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
