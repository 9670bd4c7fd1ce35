#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "idl/messages.hpp"
#include "kicking/optional_double.hpp"
#include "kicking/outcome/outcome.hpp"
#include "kicking/policy/policy.hpp"
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

}  // namespace trivela::experiment
