#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "evaluator/render/json_values.hpp"

namespace trivela::evaluator {

/// What is not the same in all logs of a comparison.
struct LogDifference {
  std::string part;                              ///< "settings", "robot 2", "scenario", "sessions"
  std::string key;                               ///< "policy.keep_off_m"
  std::vector<std::vector<std::string>> values;  ///< by log: those of its sessions, each once; none: it has no such key
};

/// Keys of the configurations (settings, robots, scenario) and what else was noted of the sessions: version, messages,
/// scenario, seeds, policies, robots. Throws std::runtime_error where a log cannot be read.
std::vector<LogDifference> log_differences(std::span<const std::filesystem::path> logs);

/// A log's values of a key: "2.5, 3.0 and 4 more"; "none".
std::string shown_values(const std::vector<std::string>& values);

/// A line for each, at most `most` of them: "settings policy.keep_off_m: 2.5 in a.db; 3.0 in b.db"; where there is
/// none, that.
std::string differences_text(const std::vector<LogDifference>& differences, std::span<const std::string> logs,
                             std::size_t most);

/// [{part, key, values: [{log, values}]}]
Json differences_json(const std::vector<LogDifference>& differences, std::span<const std::string> logs);

}  // namespace trivela::evaluator
