#pragma once

#include <string>
#include <vector>

#include "log/merge/merge.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// What `trivela merge` says of a new log.
struct MergeReport {
  std::string table;                   ///< of the files, as text
  std::string total;                   ///< a sentence: sessions, robots, rows, kicks
  std::vector<std::string> notes;      ///< sentences on clocks
  std::vector<std::string> conflicts;  ///< sentences on kicks of which two sources say different things
  /// Sentences on what no file has:
  /// - files and sessions that could not be read whole, rows that the recorder lost, silences
  /// - times in which nobody recorded a robot
  /// - kicks that a driver counted and no session has
  std::vector<std::string> missing;
};

/// Asks the new log, in which each kick counts once (evaluator/sessions/log_sessions.hpp).
MergeReport report_merge(const log::Merged& merged, log::Reader&& reader);

/// "robot 3", "the base".
std::string participant(int robot_id);

}  // namespace trivela::evaluator
