#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace trivela::log {

/// One of the parts in which the matches of an experiment are played on several machines.
struct Shard {
  std::uint32_t number = 1;  ///< from 1
  std::uint32_t count = 1;
  bool operator==(const Shard&) const = default;

  /// "2/4"
  std::string text() const;
};

/// Matches from `begin` up to, not including, `end`.
struct MatchRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t size() const { return end - begin; }
};

/// The shard's share of `matches`: neighbouring ones, as many as any other shard has, give or take one. None: all.
MatchRange range_of(const std::optional<Shard>& shard, std::uint32_t matches);

/// What table `experiments` says of a shard's log.
struct ShardStamp {
  std::string arguments;  ///< of the whole experiment
  Shard shard;
  std::uint32_t matches = 0;  ///< of the whole experiment, of each arm
};

/// The stamp as arguments of a log: those of the whole, and a last line that says which part of it this is.
std::string stamped_arguments(const ShardStamp& stamp);

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
/// - Stopped where `told` says so.
/// - std::runtime_error naming the file where it is no shard, of another experiment or version, damaged or not
/// finished.
/// - std::runtime_error where two say different things of a session, or one is missing.
/// - std::runtime_error where `to` exists or cannot be written.
MergedShards merge_shards(
    const std::vector<std::filesystem::path>& files, const std::filesystem::path& to,
    const std::function<bool(std::int64_t read, std::int64_t all)>& told = [](auto, auto) { return true; });

}  // namespace trivela::log
