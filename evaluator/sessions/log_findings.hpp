#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// How bad what a check found is.
enum class Health {
  kOk,        ///< nothing is wrong
  kDoubtful,  ///< something is missing, or may not be what it seems
  kBad,       ///< the log cannot be read, or is not what was recorded
};

/// One check of a log: what was found, and what to do about it, unless all is well.
struct LogFinding {
  std::string check;
  Health health = Health::kOk;
  std::string value;
  std::string advice;
};

/// Each check of a match log at least once, always in the same order, every row compared with its digest; a file that
/// cannot be read has findings on that alone. The file is only read. Nothing is thrown.
std::vector<LogFinding> examine_log(const std::filesystem::path& path);

/// Kicks of which these logs say different things.
std::vector<LogFinding> compare_logs(const std::vector<std::filesystem::path>& paths);

/// Clocks that jumped: a stream whose instants fall back, a clock that was measured elsewhere within seconds, and UTC
/// that is another one in the session that goes on. For examine_log().
std::vector<LogFinding> clock_findings(const log::Reader& reader);

}  // namespace trivela::evaluator
