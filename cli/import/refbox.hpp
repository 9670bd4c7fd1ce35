#pragma once

#include <cstdint>
#include <filesystem>
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

/// What of a box's logs stands in the match log.
struct ImportedRows {
  std::int64_t referee = 0;
  std::int64_t world_states = 0;
  std::int64_t without_velocity = 0;  ///< world states left out: no velocity was told, and none followed from the poses
};

/// Writes the match log of one text log and the records of one side's team: a row of `referee` a command (robot 0: the
/// box's own word), a world state a robot and record, in the team's own F. Standard deviations stand as 0, the ball's
/// age and opponents as NULL: the box is not told them. `sentences` stand in the log. Throws std::runtime_error where
/// the log cannot be written; what was begun is removed.
/// `ours`: the side whose goals and restarts are our own.
ImportedRows write_match_log(const evaluator::imports::RefereeLog& referee, evaluator::imports::BoxSide ours,
                             const evaluator::imports::SidedTeamLog* team, const std::vector<std::string>& sentences,
                             const std::filesystem::path& out);

}  // namespace trivela::cli
