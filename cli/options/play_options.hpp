#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/verbs.hpp"
#include "config/text/installation.hpp"
#include "log/shards/shards.hpp"
#include "sim/scenario.hpp"

namespace trivela::cli {

/// A scenario file and values on top of it.
struct World {
  std::string file = config::shipped("scenarios/default.toml").string();
  std::vector<std::string> changes;  ///< lines of TOML, e.g. "keeper.reaction_s = 0.15"

  /// Throws config::Error naming file or line, key and value.
  sim::Scenario load() const;

  /// Throws UsageError where a change is of something that none of the scenarios has, such as a keeper.
  void require_effect(const std::vector<sim::Scenario>& played) const;

  /// `base`, which is the file's name with or without its ending, and the changes.
  std::string named(const std::string& base) const;
};

/// --scenario, --world, and --calibrations, whose number may be nullptr: then without it.
void add_world_options(CLI::App& verb, World& world, std::uint32_t* calibrations = nullptr);

/// --shard K/N; `footnote` ends its help.
void add_shard_option(CLI::App& verb, std::optional<log::Shard>& shard, const std::string& footnote);

/// Throws UsageError where there are more shards than matches.
void check_shard(const std::optional<log::Shard>& shard, std::uint32_t matches);

}  // namespace trivela::cli
