#include "log/shards/shard.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
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
  std::array<std::int64_t, 3> numbers{};
  const char* from = arguments.data() + at + kMark.size();
  const char* const end = arguments.data() + arguments.size();
  for (std::int64_t& number : numbers) {
    const auto [stopped, error] = std::from_chars(from, end, number);
    if (error != std::errc{} || stopped == end) return std::nullopt;
    from = stopped + 1;  // behind a blank or the end of the line
  }
  const auto [number, count, matches] = numbers;
  if (from != end || number < 1 || count < number || count > matches || matches > INT64_C(0xFFFFFFFF))
    return std::nullopt;
  return ShardStamp{
      arguments.substr(0, at), {static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(count)}, matches};
}

}  // namespace trivela::log
