#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace trivela::nodes {

/// What names the folder of keys where `--secure` does not.
inline constexpr const char* kKeysVariable = "TRIVELA_SECURITY";

/// What every node's command line says.
struct NodeFlags {
  std::string config_file;
  std::vector<std::string> overrides;
  std::string keys;           ///< folder of trivela keys; empty: the bus is not secured
  int realtime_priority = 0;  ///< 0: none
  int processor = -1;         ///< below 0: any
};

/// Adds `--config`, `--set`, `--secure`, `--realtime` and `--processor`, and what they mean. The flags outlive the
/// parsing.
inline void add_node_flags(CLI::App& app, NodeFlags& flags) {
  app.add_option("--config", flags.config_file, "configuration (config/default.toml says what it may hold)")
      ->required();
  app.add_option("--set", flags.overrides, "one setting on top, e.g. --set run.robot_id=2");
  app.add_option("--secure", flags.keys, "speak to holders of keys alone; the folder of trivela keys, with ours")
      ->envname(kKeysVariable);
  app.add_option("--realtime", flags.realtime_priority, "SCHED_FIFO priority, locked memory")->check(CLI::Range(1, 99));
  app.add_option("--processor", flags.processor, "run on this processor alone, counted from 0")
      ->check(CLI::NonNegativeNumber);
}

}  // namespace trivela::nodes
