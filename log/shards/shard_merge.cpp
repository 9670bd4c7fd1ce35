#include "log/shards/shard_merge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "log/file/files_beside.hpp"
#include "log/file/new_file.hpp"
#include "log/read/reader.hpp"
#include "log/schema/digest.hpp"
#include "log/schema/row_digest.hpp"
#include "log/schema/schema.hpp"
#include "log/shards/shard.hpp"

namespace trivela::log {
namespace {

/// A shard on its way into the whole.
struct ShardFile {
  std::filesystem::path path;
  ShardStamp stamp;
};

/// The sentence that refuses a file.
std::runtime_error refused_shard(const std::filesystem::path& path, const std::string& why) {
  return std::runtime_error(fmt::format("{}: {}", path.string(), why));
}

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

/// Throws refused_shard() where the shard should have another number of matches than it says.
void check_share(const ShardFile& file, std::int64_t matches) {
  const MatchRange range = range_of(file.stamp.shard, static_cast<std::uint32_t>(file.stamp.matches));
  if (range.size() == matches) return;
  throw refused_shard(file.path, fmt::format("shard {} should have {} matches and not {}", file.stamp.shard.text(),
                                             range.size(), matches));
}

/// Sorts the files by shard. Throws std::runtime_error unless they are all shards of one experiment, each once.
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

namespace fs = std::filesystem;

/// With the matches that it shall have, and has.
struct ExperimentFile : ShardFile {
  std::int64_t matches = 0;
  std::int64_t done = 0;
  bool is_shard = false;  // false: a whole experiment, as its one part
};

/// A shard's log or that of a whole experiment; none: another log.
std::optional<ExperimentFile> experiment_in(const fs::path& path, const Reader& reader) {
  std::optional<ExperimentFile> found;
  std::int64_t experiments = 0;
  reader.query("SELECT arguments, matches, matches_done FROM experiments",
               [&](const std::string& arguments, std::int64_t matches, std::int64_t done) {
                 ++experiments;
                 const auto stamp = stamp_of(arguments);
                 found = ExperimentFile{
                     {path, stamp.value_or(ShardStamp{arguments, Shard{}, matches})}, matches, done, stamp.has_value()};
               });
  return experiments == 1 ? found : std::nullopt;
}

ExperimentFile read_shard(const fs::path& path) {
  const Reader reader(path, Check::kWhole);
  const auto file = experiment_in(path, reader);
  if (!file) throw refused_shard(path, "is no shard of an experiment (trivela simulate --shard), the other files are");
  if (file->done != file->matches)
    throw refused_shard(path, fmt::format("shard {} has {} of its {} matches: the command that began it goes on from "
                                          "there",
                                          file->stamp.shard.text(), file->done, file->matches));
  check_share(*file, file->matches);
  return *file;
}

/// Rows of its sessions, by their digests.
std::map<std::int64_t, std::string> digests_of(const fs::path& path) {
  std::map<std::int64_t, std::string> digests;
  Reader(path, Check::kSchema)
      .query("SELECT session_id, sha256 FROM digests",
             [&](std::int64_t session_id, const std::string& sha256) { digests[session_id] = sha256; });
  return digests;
}

/// Throws where `part` has a session that `all` has not, or has with other rows.
void check_part(const ExperimentFile& part, const ExperimentFile& all) {
  const auto rows = digests_of(all.path);
  for (const auto& [session_id, sha256] : digests_of(part.path)) {
    const auto there = rows.find(session_id);
    if (there != rows.end() && there->second == sha256) continue;
    throw refused_shard(part.path,
                        fmt::format("of session {} it says something else than {}", session_id, all.path.string()));
  }
}

/// Leaves out what says nothing new: a shard that is there already, and, where the whole experiment is, every shard.
/// Throws where two files say different things of the same matches. Returns what was left out: of it comes along what
/// people say.
std::vector<ExperimentFile> leave_out_repeated(std::vector<ExperimentFile>& files) {
  const auto whole = std::ranges::find(files, false, &ExperimentFile::is_shard);
  std::vector<ExperimentFile> kept, repeated;
  for (const ExperimentFile& file : files) {
    const auto there = std::ranges::find_if(kept, [&](const ExperimentFile& other) {
      return other.stamp.arguments == file.stamp.arguments && other.stamp.shard == file.stamp.shard;
    });
    const bool has_whole = whole != files.end() && whole->stamp.arguments == file.stamp.arguments;
    if (has_whole && &file != &*whole) {
      check_part(file, *whole);
      repeated.push_back(file);
    } else if (there != kept.end()) {
      check_part(file, *there);
      repeated.push_back(file);
    } else {
      kept.push_back(file);
    }
  }
  files = std::move(kept);
  return repeated;
}

/// In the order of the keys, as one run writes them; or what is said of them alone.
void copy_rows(SQLite::Database& database, const ShardFile& file, bool said_alone) {
  SQLite::Statement attach(database, "ATTACH ? AS shard");
  attach.bind(1, name_of_main_file(file.path));
  attach.exec();
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  if (!said_alone) {
    database.exec("INSERT OR IGNORE INTO main.texts SELECT * FROM shard.texts");
    database.exec("INSERT INTO main.digests SELECT * FROM shard.digests");
    for (const DigestedTable& table : digested_tables())
      database.exec(fmt::format("INSERT INTO main.{0} SELECT * FROM shard.{0} ORDER BY {1}", table.name, table.key));
  }
  for (const std::string_view table : kSaidAfterwards)
    database.exec(fmt::format("INSERT OR IGNORE INTO main.{0} SELECT * FROM shard.{0}", table));
  transaction.commit();
  attach.reset();
  database.exec("DETACH shard");
}

void write_whole(SQLite::Database& database, const ShardStamp& stamp) {
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
      const auto found = experiment_in(path, Reader(path, Check::kSchema));
      return found && found->is_shard;
    } catch (const std::exception&) {
      return false;  // merging says what is wrong with it
    }
  });
}

MergedShards merge_shards(const std::vector<fs::path>& files, const fs::path& to,
                          const std::function<bool(std::size_t, std::size_t)>& told) {
  std::vector<ExperimentFile> found;
  found.reserve(files.size());
  for (const fs::path& path : files) found.push_back(read_shard(path));
  const std::vector<ExperimentFile> repeated = leave_out_repeated(found);
  std::vector<ShardFile> shards(found.begin(), found.end());
  check_set(shards);
  MergedShards merged{
      .shards = static_cast<std::int64_t>(shards.size()), .sessions = 0, .matches = shards.front().stamp.matches};
  std::size_t done = 0;
  const auto goes_on = [&] { return told(done, shards.size()); };
  if (!goes_on()) throw Stopped{};
  const auto database = new_file(to, kMatchLog, [&](SQLite::Database& made) {
    made.exec("PRAGMA trusted_schema = OFF");
    create_tables(made);
    stoppable(made, goes_on, [&] {
      for (const ShardFile& file : shards) {
        copy_rows(made, file, false);
        ++done;
      }
    });
    if (!goes_on()) throw Stopped{};
    for (const ShardFile& file : repeated) copy_rows(made, file, true);
    write_whole(made, shards.front().stamp);
    merged.sessions = made.execAndGet("SELECT count(*) FROM sessions").getInt64();
  });
  fold(*database);
  return merged;
}

}  // namespace trivela::log
