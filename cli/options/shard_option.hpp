#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>

#include "log/shards/shards.hpp"

namespace trivela::cli {

/// --shard K/N; `footnote` ends its help.
void add_shard_option(CLI::App& verb, std::optional<log::Shard>& shard, const std::string& footnote);

/// Throws UsageError where there are more shards than matches.
void check_shard(const std::optional<log::Shard>& shard, std::uint32_t matches);

}  // namespace trivela::cli
