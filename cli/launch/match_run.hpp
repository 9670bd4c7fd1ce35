#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/launch/signals.hpp"

namespace trivela::cli {

/// What a feeder says on its standard output: settings by which its devices are found, "KEY=VALUE", then "t_s total_s"
/// lines of progress, of which the last one says "end".
class ProgressPipe {
 public:
  /// Throws std::runtime_error where the system has no pipe.
  ProgressPipe();
  ProgressPipe(const ProgressPipe&) = delete;
  ProgressPipe& operator=(const ProgressPipe&) = delete;
  ~ProgressPipe();

  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_write_end();

  /// Takes what has come; true at the end of the stream.
  bool take();

  double played_s() const { return played_s_; }
  double total_s() const { return total_s_; }
  /// The settings before the first line of progress.
  const std::vector<std::string>& settings() const { return settings_; }
  /// A line of progress has come: the settings are complete.
  bool begun() const { return begun_; }
  /// The feeder has said that all was played.
  bool whole() const { return whole_; }

 private:
  void take_line(const std::string& line);

  std::array<int, 2> ends_{-1, -1};
  std::string text_;
  std::vector<std::string> settings_;
  double played_s_ = 0.0;
  double total_s_ = 0.0;
  bool begun_ = false;
  bool whole_ = false;
};

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
