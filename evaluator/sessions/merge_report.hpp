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
  std::vector<std::string> missing;    ///< sentences on what no file has; empty: nothing
};

/// Asks the new log, in which each kick counts once (evaluator/sessions/log_sessions.hpp).
MergeReport report_merge(const log::Merged& merged, log::Reader&& reader);

/// "robot 3", "the base".
std::string participant(int robot_id);

/// Sentences on what a merged log lacks: files and sessions that could not be read whole, rows lost while they were
/// recorded, silences, times in which a robot was recorded by nobody, and kicks that its driver counted and that stand
/// in no session. What one recorder missed and another one has is not missing.
std::vector<std::string> merge_gaps(const log::Merged& merged, const log::Reader& reader);

}  // namespace trivela::evaluator
