#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace trivela::log {

/// What the shards of an experiment were made into.
struct MergedShards {
  std::size_t shards = 0;
  std::size_t sessions = 0;
  std::uint32_t matches = 0;  ///< of each arm
};

/// Is any of the files a shard's log of `trivela simulate`? What cannot be read is none.
bool any_is_shard(const std::vector<std::filesystem::path>& files);

/// merge() of the shards of one experiment, in any order, into the rows that one run writes. A shard may be there
/// twice, and beside the whole experiment's log. `told`: rows that were read, of how many; false: stop.
/// Throws, and leaves nothing behind:
/// - Stopped where `told` says so
/// - std::runtime_error naming the file where it is no shard, of another experiment or version, damaged or not finished
/// - std::runtime_error where two say different things of a session, one is missing, or `to` exists or cannot be
/// written
MergedShards merge_shards(
    const std::vector<std::filesystem::path>& files, const std::filesystem::path& to,
    const std::function<bool(std::int64_t read, std::int64_t all)>& told = [](auto, auto) { return true; });

}  // namespace trivela::log
