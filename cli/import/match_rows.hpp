#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "evaluator/imports/box_files.hpp"

namespace trivela::cli {

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
