#include "log/shards/shard_merge.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "log/merge/merge.hpp"
#include "log/read/reader.hpp"
#include "log/schema/digest.hpp"
#include "log/shards/shard.hpp"

namespace trivela::log {
namespace {

namespace fs = std::filesystem;

/// A shard's log or that of a whole experiment, with the matches that it shall have, and has.
struct Part {
  fs::path path;
  ShardStamp stamp;
  std::int64_t matches = 0;
  std::int64_t done = 0;
  bool is_shard = false;  // false: a whole experiment, as its one part
};

/// None: another log.
std::optional<Part> part_in(const fs::path& path, const Reader& reader) {
  std::vector<Part> found;
  reader.query("SELECT arguments, matches, matches_done FROM experiments", [&](const std::string& arguments,
                                                                               std::int64_t matches,
                                                                               std::int64_t done) {
    const auto stamp = stamp_of(arguments);
    found.push_back({path, stamp.value_or(ShardStamp{arguments, Shard{}, matches}), matches, done, stamp.has_value()});
  });
  return found.size() == 1 ? std::optional{found.front()} : std::nullopt;
}

/// The sentence that refuses a file.
std::runtime_error refused_shard(const fs::path& path, const std::string& why) {
  return std::runtime_error(fmt::format("{}: {}", path.string(), why));
}

Part read_part(const fs::path& path) {
  const Reader reader(path, Check::kWhole);
  const auto part = part_in(path, reader);
  if (!part) throw refused_shard(path, "is no shard of an experiment (trivela simulate --shard), the other files are");
  const std::string shard = part->stamp.shard.text();
  if (part->done != part->matches)
    throw refused_shard(path, fmt::format("shard {} has {} of its {} matches: the command that began it goes on from "
                                          "there",
                                          shard, part->done, part->matches));
  const MatchRange range = range_of(part->stamp.shard, static_cast<std::uint32_t>(part->stamp.matches));
  if (range.size() != part->matches)
    throw refused_shard(path,
                        fmt::format("shard {} should have {} matches and not {}", shard, range.size(), part->matches));
  return *part;
}

/// Throws unless all are of one experiment, and none of its shards lacks.
void check_one_experiment(const std::vector<Part>& parts) {
  const Part& first = *std::ranges::find(parts, true, &Part::is_shard);
  const std::uint32_t count = first.stamp.shard.count;
  std::set<std::string> missing;
  for (std::uint32_t shard = 1; shard <= count; ++shard) missing.insert(Shard{shard, count}.text());
  for (const Part& part : parts) {
    const bool same = part.stamp.arguments == first.stamp.arguments && part.stamp.matches == first.stamp.matches &&
                      (!part.is_shard || part.stamp.shard.count == count);
    if (!same)
      throw refused_shard(part.path, fmt::format("shard {} of {} matches is of another experiment, or cut otherwise, "
                                                 "than {} (shard {} of {})",
                                                 part.stamp.shard.text(), part.stamp.matches, first.path.string(),
                                                 first.stamp.shard.text(), first.stamp.matches));
    part.is_shard ? void(missing.erase(part.stamp.shard.text())) : missing.clear();
  }
  if (!missing.empty())
    throw std::runtime_error(fmt::format("of {} shards {} {} missing: {}", count, missing.size(),
                                         missing.size() == 1 ? "is" : "are", fmt::join(missing, ", ")));
}

/// Throws where two say different things of a session, by the digests of its rows.
void check_sessions(const std::vector<Part>& parts) {
  std::map<std::int64_t, std::pair<std::string, fs::path>> known;
  for (const Part& part : parts) {
    Reader(part.path, Check::kSchema)
        .query("SELECT session_id, sha256 FROM digests", [&](std::int64_t session_id, const std::string& sha256) {
          const auto& [there, by] = known.try_emplace(session_id, sha256, part.path).first->second;
          if (there != sha256)
            throw refused_shard(part.path,
                                fmt::format("of session {} it says something else than {}", session_id, by.string()));
        });
  }
}

/// As one run writes it: the whole experiment in place of its parts, and no word of their files.
void make_whole(SQLite::Database& database, const ShardStamp& stamp) {
  database.exec(
      "DELETE FROM experiments; DELETE FROM merged_sessions; DELETE FROM session_clocks; DELETE FROM texts WHERE text "
      "= ''");
  SQLite::Statement insert(database, "INSERT INTO experiments VALUES (?, ?, ?, ?)");
  insert.bind(1, sha256(stamp.arguments));
  insert.bind(2, stamp.arguments);
  insert.bind(3, stamp.matches);
  insert.bind(4, stamp.matches);
  insert.exec();
}

}  // namespace

bool any_is_shard(const std::vector<fs::path>& files) {
  return std::ranges::any_of(files, [](const fs::path& path) {
    try {
      const auto found = part_in(path, Reader(path, Check::kSchema));
      return found && found->is_shard;
    } catch (const std::exception&) {
      return false;  // merging says what is wrong with it
    }
  });
}

MergedShards merge_shards(const std::vector<fs::path>& files, const fs::path& to,
                          const std::function<bool(std::int64_t, std::int64_t)>& told) {
  std::vector<Part> parts;
  parts.reserve(files.size());
  for (const fs::path& path : files) parts.push_back(read_part(path));
  check_one_experiment(parts);
  check_sessions(parts);
  std::ranges::stable_sort(parts, {}, [](const Part& part) { return part.stamp.shard.number; });
  std::vector<fs::path> sorted;
  std::set<std::uint32_t> shards;
  for (const Part& part : parts) {
    sorted.push_back(part.path);
    shards.insert(part.stamp.shard.number);
  }
  const ShardStamp& stamp = parts.front().stamp;
  const Merged merged =
      merge(sorted, to, {.progress = told, .finish = [&](SQLite::Database& database) { make_whole(database, stamp); }});
  return {.shards = static_cast<std::int64_t>(shards.size()),
          .sessions = static_cast<std::int64_t>(merged.sessions.size()),
          .matches = stamp.matches};
}

}  // namespace trivela::log
