#pragma once

#include <cstdint>
#include <optional>
#include <string>

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

/// None: the arguments are those of a whole experiment.
std::optional<ShardStamp> stamp_of(const std::string& arguments);

}  // namespace trivela::log
