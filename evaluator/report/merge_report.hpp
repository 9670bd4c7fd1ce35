#pragma once

#include <string>
#include <vector>

#include "evaluator/log/merge.hpp"
#include "evaluator/log/reader.hpp"

namespace trivela::evaluator {

/// What `trivela merge` says of a new log.
struct MergeReport {
  std::string table;                   ///< of the files, as text
  std::string total;                   ///< a sentence: sessions, robots, rows, kicks
  std::vector<std::string> notes;      ///< sentences on clocks
  std::vector<std::string> conflicts;  ///< sentences on kicks of which two sources say different things
  std::vector<std::string> missing;    ///< sentences on what no file has; empty: nothing
};

/// Asks the new log, in which each kick counts once (evaluator/report/log_sessions.hpp).
MergeReport report_merge(const log::Merged& merged, const log::Reader& reader);

}  // namespace trivela::evaluator
