#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "log/shards/shard.hpp"

namespace trivela::log {

/// A shard on its way into the whole.
struct ShardFile {
  std::filesystem::path path;
  ShardStamp stamp;
};

/// The sentence that refuses a file.
std::runtime_error refused_shard(const std::filesystem::path& path, const std::string& why);

/// Throws refused_shard() where the shard should have another number of matches than it says.
void check_share(const ShardFile& file, std::int64_t matches);

/// Sorts the files by shard. Throws std::runtime_error unless they are all shards of one experiment, each once.
void check_set(std::vector<ShardFile>& files);

}  // namespace trivela::log
