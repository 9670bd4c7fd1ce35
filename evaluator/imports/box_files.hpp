#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluator/imports/referee_log.hpp"
#include "evaluator/imports/team_log.hpp"

namespace trivela::evaluator::imports {

/// A team's log with the side that the box had it on.
struct SidedTeamLog {
  BoxSide side = BoxSide::kCyan;
  TeamLog log;
};

/// Everything that was found in the files.
struct BoxLogs {
  std::vector<RefereeLog> referee;
  std::vector<SidedTeamLog> teams;

  /// Lines and records that could not be used.
  std::int64_t unusable() const;

  /// What is wrong with the files, a sentence a fault.
  std::vector<std::string> faults() const;
};

/// Reads text logs, team logs and zip archives of both, as a referee box leaves them. A file is a team's log where its
/// name ends in .A.msl (cyan) or .B.msl (magenta) or where it begins as JSON does; of an archive what does not end in
/// .msl is passed over. Throws std::runtime_error naming file and reason where one cannot be opened, or an archive not
/// be read, or has no log.
BoxLogs read_box_logs(const std::vector<std::filesystem::path>& files);

}  // namespace trivela::evaluator::imports
