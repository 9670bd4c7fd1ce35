#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/launch/signal_inbox.hpp"

namespace trivela::cli {

/// How a match went.
struct MatchResult {
  double played_s = 0.0;
  double wall_s = 0.0;
  std::string trouble;  ///< empty: played to the end
};

/// Starts the processes `nodes`, the recorder first, and their `feeder` (the simulator) with one
/// configuration file, waits until the feeder is through, a node dies or somebody asks to stop through `signals`, and
/// ends them all, the recorder last, so that the log is finalised. `quiet`: what they print on standard output is not
/// shown. Draws a progress bar on a terminal.
MatchResult run_match(const std::string& feeder, const std::filesystem::path& config_file, SignalInbox& signals,
                      const std::vector<std::string>& nodes, bool quiet = false);

/// The file of the nodes' configuration, made of the settings by which they find the emulated devices.
using NodesConfig = std::function<std::filesystem::path(const std::vector<std::string>& settings)>;

/// The same in real time against the simulator's emulated devices: the simulator is started first, with `world_config`,
/// and says where its devices are; it stays until the nodes have ended. Throws what `nodes_config` throws.
MatchResult run_emulated_match(const std::filesystem::path& world_config, const NodesConfig& nodes_config,
                               SignalInbox& signals, const std::vector<std::string>& nodes);

}  // namespace trivela::cli
