#pragma once

#include <cstdint>
#include <vector>

#include "evaluator/counting/log_opportunities.hpp"
#include "evaluator/counting/truth_count.hpp"
#include "evaluator/sessions/log_sessions.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// Play of a possession as one recording heard it from one robot's referee.
struct HeardSpan {
  std::uint32_t session = 0;
  int of_robot = 0;  ///< that counts its own possessions; 0: the referee counts them, for all
  int half = 0;
  std::int64_t possession_id = 0;
  std::int64_t from_ns = 0;  ///< by UTC, in lockstep by the simulator's clock
  std::int64_t to_ns = 0;
  std::int64_t played_ns = 0;
};

/// The policies that a session says were in charge of its halves.
struct PolicyOfHalf {
  std::uint32_t session = 0;
  int half = 0;
  PolicyOfRobot who;  ///< robot 0: each that has none of its own
};

/// What logs say of play and of who was in charge of it.
struct HeardPlay {
  std::vector<HeardSpan> spans;
  std::vector<PolicyOfHalf> policies;
};

/// Adds what a log says of these sessions. Possessions that `truths` knows go by the simulator's count.
void hear_play(const log::Reader& reader, const SessionPlaces& sessions, const TruthCount& truths, HeardPlay& heard);

/// Minutes of play of each possession, once, however many recordings and robots heard the referee: the time that any of
/// them covers. `logged` has the sessions and the opportunities, whose robots had the ball. A possession that nobody is
/// known to have had is of the policy of its half, where all robots of the session have the same one.
std::vector<PlayedSpan> played_spans(const HeardPlay& heard, const LoggedOpportunities& logged);

}  // namespace trivela::evaluator
