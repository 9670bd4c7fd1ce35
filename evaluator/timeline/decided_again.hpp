#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "evaluator/counting/log_opportunities.hpp"

namespace trivela::evaluator {

/// An order in a possession.
struct PossessionOrder {
  double at_s = 0.0;        ///< since the session began
  std::int64_t number = 0;  ///< of the robot's orders in its own session, from 1
  std::string policy;
  std::optional<double> power;
  std::optional<double> p_on_target;  ///< as it was predicted
  std::string became;                 ///< refused, or the label that holds; empty: nothing is known
};

/// A possession of a recorded match, by the robot's own count then, in which one of the two ordered a kick.
struct PossessionOrders {
  int robot_id = 0;
  int half = 0;
  std::int64_t possession_id = 0;
  std::optional<PossessionOrder> recorded;  ///< the first order that was not refused, else the first one
  std::optional<PossessionOrder> replayed;  ///< the first order
};

/// A match and a replay of it.
struct DecidedAgain {
  std::string uuid;                      ///< of the recorded session
  std::string log, again_log;            ///< names of the files
  std::int64_t possessions = 0;          ///< with a recorded decision in play
  std::vector<PossessionOrders> orders;  ///< by robot and time
};

/// The replays among the logs, each beside the session that it replays, where that is there too. Throws
/// std::runtime_error where a log cannot be read.
std::vector<DecidedAgain> decided_again(const std::vector<OpenLog>& logs);

/// How many possessions have an order in the recording, in the replay, in both and when.
std::vector<std::string> sentences_of(const DecidedAgain& again);

/// A row for each possession, below a head.
std::vector<std::vector<std::string>> table_of(const DecidedAgain& again);

}  // namespace trivela::evaluator
