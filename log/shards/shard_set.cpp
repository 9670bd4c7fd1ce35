#include "log/shards/shard_set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace trivela::log {
namespace {

void check_one_experiment(const std::vector<ShardFile>& files) {
  const ShardFile& first = files.front();
  for (const ShardFile& file : files) {
    const bool same = file.stamp.arguments == first.stamp.arguments && file.stamp.matches == first.stamp.matches &&
                      file.stamp.shard.count == first.stamp.shard.count;
    if (same) continue;
    throw refused_shard(file.path,
                        fmt::format("shard {} of {} matches is of another experiment, or cut otherwise, than {} (shard "
                                    "{} of {})",
                                    file.stamp.shard.text(), file.stamp.matches, first.path.string(),
                                    first.stamp.shard.text(), first.stamp.matches));
  }
}

}  // namespace

std::runtime_error refused_shard(const std::filesystem::path& path, const std::string& why) {
  return std::runtime_error(fmt::format("{}: {}", path.string(), why));
}

void check_share(const ShardFile& file, std::int64_t matches) {
  const MatchRange range = range_of(file.stamp.shard, static_cast<std::uint32_t>(file.stamp.matches));
  if (range.size() == matches) return;
  throw refused_shard(file.path, fmt::format("shard {} should have {} matches and not {}", file.stamp.shard.text(),
                                             range.size(), matches));
}

void check_set(std::vector<ShardFile>& files) {
  const auto number = [](const ShardFile& file) { return file.stamp.shard.number; };
  std::ranges::stable_sort(files, {}, number);
  check_one_experiment(files);
  const auto twice = std::ranges::adjacent_find(files, {}, number);
  if (twice != files.end())
    throw refused_shard(
        twice->path, fmt::format("shard {} is in {}, too", twice->stamp.shard.text(), std::next(twice)->path.string()));
  const std::uint32_t count = files.front().stamp.shard.count;
  std::vector<std::string> missing;
  auto next = files.begin();
  for (std::uint32_t shard = 1; shard <= count; ++shard) {
    if (next != files.end() && number(*next) == shard) {
      ++next;
    } else {
      missing.push_back(Shard{shard, count}.text());
    }
  }
  if (missing.empty()) return;
  throw std::runtime_error(fmt::format("of {} shards {} {} missing: {}", count, missing.size(),
                                       missing.size() == 1 ? "is" : "are", fmt::join(missing, ", ")));
}

}  // namespace trivela::log
