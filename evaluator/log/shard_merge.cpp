#include "evaluator/log/shard_merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "evaluator/log/digest.hpp"
#include "evaluator/log/new_file.hpp"
#include "evaluator/log/reader.hpp"
#include "evaluator/log/row_digest.hpp"
#include "evaluator/log/schema.hpp"
#include "evaluator/log/shard_set.hpp"

namespace trivela::evaluator::log {
namespace {

namespace fs = std::filesystem;

/// With the matches that it shall have, and has.
struct FoundShard : ShardFile {
  std::int64_t matches = 0;
  std::int64_t done = 0;
};

/// None: a log, but no shard's.
std::optional<FoundShard> shard_in(const fs::path& path, const Reader& reader) {
  std::optional<FoundShard> found;
  std::int64_t experiments = 0;
  reader.query("SELECT arguments, matches, matches_done FROM experiments",
               [&](const std::string& arguments, std::int64_t matches, std::int64_t done) {
                 ++experiments;
                 if (const auto stamp = stamp_of(arguments)) found = FoundShard{{path, *stamp}, matches, done};
               });
  return experiments == 1 ? found : std::nullopt;
}

ShardFile read_shard(const fs::path& path) {
  const Reader reader(path, Check::kWhole);
  const auto file = shard_in(path, reader);
  if (!file) throw refused_shard(path, "is no shard of an experiment (trivela simulate --shard), the other files are");
  if (reader.version() != kMatchLog.version)
    throw refused_shard(path,
                        fmt::format("is of version {} and not {}: shards are merged by the program that played them",
                                    reader.version(), kMatchLog.version));
  if (file->done != file->matches)
    throw refused_shard(path, fmt::format("shard {} has {} of its {} matches: the command that began it goes on from "
                                          "there",
                                          file->stamp.shard.text(), file->done, file->matches));
  check_share(*file, file->matches);
  return *file;
}

/// In the order of the keys, as one run writes them.
void copy_rows(SQLite::Database& database, const ShardFile& file) {
  SQLite::Statement attach(database, "ATTACH ? AS shard");
  attach.bind(1, file.path.string());
  attach.exec();
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  database.exec("INSERT OR IGNORE INTO main.texts SELECT * FROM shard.texts");
  database.exec("INSERT INTO main.digests SELECT * FROM shard.digests");
  for (const DigestedTable& table : digested_tables())
    database.exec(fmt::format("INSERT INTO main.{0} SELECT * FROM shard.{0} ORDER BY {1}", table.name, table.key));
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
      return shard_in(path, Reader(path, Check::kSchema)).has_value();
    } catch (const std::exception&) {
      return false;  // merging says what is wrong with it
    }
  });
}

MergedShards merge_shards(const std::vector<fs::path>& files, const fs::path& to,
                          const std::function<void(std::size_t, std::size_t)>& told) {
  std::vector<ShardFile> shards;
  shards.reserve(files.size());
  for (const fs::path& path : files) shards.push_back(read_shard(path));
  check_set(shards);
  MergedShards merged{
      .shards = static_cast<std::int64_t>(shards.size()), .sessions = 0, .matches = shards.front().stamp.matches};
  const auto database = new_file(to, kMatchLog, [&](SQLite::Database& made) {
    made.exec("PRAGMA trusted_schema = OFF");
    create_tables(made);
    for (std::size_t i = 0; i < shards.size(); ++i) {
      copy_rows(made, shards[i]);
      told(i + 1, shards.size());
    }
    write_whole(made, shards.front().stamp);
    merged.sessions = made.execAndGet("SELECT count(*) FROM sessions").getInt64();
  });
  fold(*database);
  return merged;
}

}  // namespace trivela::evaluator::log
