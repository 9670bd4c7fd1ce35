#pragma once

#include <string>
#include <vector>

#include "evaluator/imports/box_files.hpp"
#include "evaluator/imports/play_statistics.hpp"

namespace trivela::cli {

/// A text log with what it says of the game.
struct RefereeSummary {
  const evaluator::imports::RefereeLog* log = nullptr;
  evaluator::imports::PlayStatistics statistics;
};

/// A team's log with its possessions.
struct TeamSummary {
  const evaluator::imports::SidedTeamLog* team = nullptr;
  std::vector<evaluator::imports::Possession> possessions;
};

/// What a box's logs say; it refers to them.
struct RefboxSummary {
  std::vector<RefereeSummary> referee;
  std::vector<TeamSummary> teams;
  std::vector<std::string> faults;
};

/// Team logs are placed in time by the text log where there is exactly one.
RefboxSummary summary_of(const evaluator::imports::BoxLogs& logs);

/// "cyan" or "magenta".
const char* side_name(evaluator::imports::BoxSide side);

/// Tables for a terminal: the game, possessions, faults.
std::string to_text(const RefboxSummary& summary);

/// `referee: [{file, commands, plays, ...}], teams: [{file, team, side, records, ...}], faults: [...]`; null where
/// there is no such number.
std::string to_json(const RefboxSummary& summary);

}  // namespace trivela::cli
