#include "log/shards/shards.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "log/merge/merge.hpp"
#include "log/read/reader.hpp"
#include "log/schema/digest.hpp"

namespace trivela::log {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = "\n### shard ";

/// A shard's log or that of a whole experiment.
struct Part {
  fs::path path;
  ShardStamp stamp;
  bool is_shard = false;  // false: a whole experiment, as its one part
  std::int64_t done = 0;  // matches
};

/// None: another log.
std::optional<Part> part_in(const fs::path& path, Check check) {
  std::vector<Part> found;
  Reader(path, check)
      .query("SELECT arguments, matches, matches_done FROM experiments",
             [&](const std::string& arguments, std::uint32_t matches, std::int64_t done) {
               const auto at = std::min(arguments.rfind(kMark), arguments.size());
               ShardStamp stamp{arguments.substr(0, at), {}, 0};
               std::istringstream{arguments.substr(std::min(at + kMark.size(), arguments.size()))} >>
                   stamp.shard.number >> stamp.shard.count >> stamp.matches;
               const auto [number, count] = stamp.shard;
               const bool is_shard =
                   number >= 1 && number <= count && count <= stamp.matches && stamped_arguments(stamp) == arguments;
               found.push_back({path, is_shard ? stamp : ShardStamp{arguments, {}, matches}, is_shard, done});
             });
  return found.size() == 1 ? std::optional{found.front()} : std::nullopt;
}

/// The sentence that refuses a file.
std::runtime_error refused_shard(const fs::path& path, const std::string& why) {
  return std::runtime_error(path.string() + ": " + why);
}

/// Throws unless all are of one experiment, and none of its shards lacks.
void check_one_experiment(const std::vector<Part>& parts) {
  const Part& first = *std::ranges::find(parts, true, &Part::is_shard);
  const auto& [arguments, shard, matches] = first.stamp;
  std::set<std::string> missing;
  for (std::uint32_t number = 1; number <= shard.count; ++number) missing.insert(Shard{number, shard.count}.text());
  for (const Part& part : parts) {
    const auto& [own_arguments, own_shard, own_matches] = part.stamp;
    if (own_arguments != arguments || own_matches != matches || (part.is_shard && own_shard.count != shard.count))
      throw refused_shard(part.path,
                          fmt::format("shard {} of {} matches is of another experiment, or cut otherwise, than {} "
                                      "(shard {} of {})",
                                      own_shard.text(), own_matches, first.path.string(), shard.text(), matches));
    part.is_shard ? void(missing.erase(own_shard.text())) : missing.clear();
  }
  if (!missing.empty())
    throw std::runtime_error(fmt::format("of {} shards {} {} missing: {}", shard.count, missing.size(),
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
  SQLite::Statement insert(database, "INSERT INTO experiments VALUES (?1, ?2, ?3, ?3)");
  SQLite::bind(insert, sha256(stamp.arguments), stamp.arguments, stamp.matches);
  insert.exec();
}

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

bool any_is_shard(const std::vector<fs::path>& files) {
  return std::ranges::any_of(files, [](const fs::path& path) {
    try {
      const auto found = part_in(path, Check::kSchema);
      return found && found->is_shard;
    } catch (const std::exception&) {
      return false;  // merging says what is wrong with it
    }
  });
}

MergedShards merge_shards(const std::vector<fs::path>& files, const fs::path& to,
                          const std::function<bool(std::int64_t, std::int64_t)>& told) {
  std::vector<Part> parts;
  for (const fs::path& path : files) {
    const auto part = part_in(path, Check::kWhole);
    if (!part)
      throw refused_shard(path, "is no shard of an experiment (trivela simulate --shard), the other files are");
    const std::int64_t matches = range_of(part->stamp.shard, part->stamp.matches).size();
    if (part->done != matches)
      throw refused_shard(path, fmt::format("shard {} has {} of its {} matches: the command that began it goes on from "
                                            "there",
                                            part->stamp.shard.text(), part->done, matches));
    parts.push_back(*part);
  }
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
  return {shards.size(), merged.sessions.size(), stamp.matches};
}

}  // namespace trivela::log
