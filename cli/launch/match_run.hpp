#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace trivela::cli {

/// How a match went.
struct MatchResult {
  double played_s = 0.0;
  double wall_s = 0.0;
  std::string trouble;  ///< empty: played to the end
};

/// Starts the node processes and the simulator with one configuration file, waits until the match is over, a node dies
/// or somebody asks to stop, and ends them all, the recorder last, so that the log is finalised. `programs`: the folder
/// of the node programs. Draws a progress bar on a terminal.
MatchResult run_match(const std::filesystem::path& programs, const std::filesystem::path& config_file);

}  // namespace trivela::cli
