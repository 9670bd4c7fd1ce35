#include "log/shards/shard.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string_view>

namespace trivela::log {
namespace {

constexpr std::string_view kMark = "\n### shard ";

}  // namespace

std::string Shard::text() const { return fmt::format("{}/{}", number, count); }

MatchRange range_of(const std::optional<Shard>& shard, std::uint32_t matches) {
  if (!shard) return {0, matches};
  const auto share = [&](std::uint32_t shards) {
    return static_cast<std::uint32_t>(std::uint64_t{matches} * shards / shard->count);
  };
  return {share(shard->number - 1), share(shard->number)};
}

std::string stamped_arguments(const ShardStamp& stamp) {
  return fmt::format("{}{}{} {} {}\n", stamp.arguments, kMark, stamp.shard.number, stamp.shard.count, stamp.matches);
}

std::optional<ShardStamp> stamp_of(const std::string& arguments) {
  const auto at = arguments.rfind(kMark);
  if (at == std::string::npos) return std::nullopt;
  ShardStamp stamp{arguments.substr(0, at), {}, 0};
  std::istringstream numbers{arguments.substr(at + kMark.size())};
  numbers >> stamp.shard.number >> stamp.shard.count >> stamp.matches;
  const auto [number, count] = stamp.shard;
  const bool holds = number >= 1 && number <= count && count <= stamp.matches && stamped_arguments(stamp) == arguments;
  return holds ? std::optional{stamp} : std::nullopt;
}

}  // namespace trivela::log
