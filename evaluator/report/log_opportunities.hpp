#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evaluator/report/kick_book.hpp"
#include "evaluator/report/session_setup.hpp"

namespace trivela::evaluator {

/// A session as a comparison needs it.
struct ComparedSession {
  std::int64_t session_id = 0;
  std::int64_t started_utc_ns = 0;
  std::optional<std::int64_t> closed_utc_ns;
  std::optional<std::int64_t> seed;
  std::string scenario;
  bool simulated = false;
  std::string arm;    ///< empty: none
  std::string table;  ///< empty: none
  std::optional<std::int64_t> match_id;
  std::string config_sha256;
  std::optional<std::int64_t> calibration_id;
  SessionSetup setup;
  std::uint32_t match = 0;  ///< number of its match over all logs, from 0
};

/// What the robot believed when it first had to decide in a possession.
struct FirstDecision {
  double distance_m = 0.0;  ///< ball to target
  double x_m = 0.0;         ///< of the robot, to the right of the goal's middle
  std::optional<double> opponent_distance_m;
};

/// An opportunity as a log has it; also a kick whose possession is not known.
struct LoggedOpportunity {
  std::uint32_t session = 0;  ///< place in the sessions
  int robot_id = 0;
  int half = 0;
  std::int64_t possession_id = 0;
  std::string policy;
  std::optional<double> probability;       ///< with which the policy was put in charge
  std::optional<double> start_distance_m;  ///< robot to the middle of the goal at the start, by the simulator's truth
  std::optional<double> start_x_m;         ///< to the right of the goal's middle at the start, by the same
  std::optional<double> distance_m;        ///< ball to target at the kick, as the robot believed; none: no kick
  std::optional<FirstDecision> first;      ///< none: the log has not every cycle
  Ending ending = Ending::kNoKick;
  double doubt = 0.0;                   ///< probability that a kick called inside was not, or one called outside was
  bool blocked = false;                 ///< the kick, an Ending::kOutside
  std::optional<bool> bounced{};        ///< as observed
  std::optional<bool> truth_bounced{};  ///< by the simulator's truth
  bool saved = false;                   ///< by the simulator's truth
  bool goal = false;                    ///< by the simulator's truth
  bool has_possession = true;           ///< false: a kick alone
};

/// Minutes of play of a half.
struct LoggedHalf {
  std::uint32_t session = 0;
  int half = 0;
  std::string policy;  ///< empty: drawn for each possession
  double minutes = 0.0;
};

/// What logs know of opportunities and kicks, their sessions merged.
struct LoggedOpportunities {
  std::vector<ComparedSession> sessions;
  std::vector<LoggedOpportunity> rows;
  std::vector<LoggedHalf> halves;
  std::uint32_t matches = 0;
  std::vector<std::string> remarks;  ///< sentences on sessions that were not closed, that stand twice, and on loss
};

/// Sessions are one match that have the same match_id or seed and world; recorded on robots: that overlap in time. A
/// session that stands in several logs counts once, and so does a match of an experiment that was played again with the
/// same configuration. Throws std::runtime_error where a log cannot be read.
LoggedOpportunities read_opportunities(const std::vector<std::filesystem::path>& logs, bool truth);

}  // namespace trivela::evaluator
