#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "evaluator/log/files_beside.hpp"
#include "evaluator/log/log_file.hpp"
#include "evaluator/log/new_file.hpp"
#include "evaluator/log/shard_set.hpp"
#include "evaluator/log/stoppable.hpp"
#include "evaluator/log/tally_book.hpp"

namespace trivela::evaluator::log {
namespace {

namespace fs = std::filesystem;

ShardFile read_book_shard(const fs::path& path) {
  const LogFile file(path, kTallyBook, Check::kWhole);
  std::optional<ShardFile> shard;
  file.query("SELECT arguments, matches, finished FROM studies",
             [&](const std::string& arguments, std::int64_t matches, bool finished) {
               const auto stamp = stamp_of(arguments);
               if (!stamp) throw refused_shard(path, "is no shard of a study (--shard K/N), the other files are");
               shard = ShardFile{path, *stamp};
               check_share(*shard, matches);
               if (!finished)
                 throw refused_shard(path, fmt::format("shard {} is not finished: the command that began it goes on "
                                                       "from there",
                                                       stamp->shard.text()));
             });
  if (!shard) throw refused_shard(path, "says of no study that it is a shard of it");
  return *shard;
}

void copy_book_rows(SQLite::Database& database, const fs::path& path) {
  SQLite::Statement attach(database, "ATTACH ? AS shard");
  attach.bind(1, name_of_main_file(path));
  attach.exec();
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  database.exec("INSERT OR IGNORE INTO main.arms SELECT * FROM shard.arms");
  database.exec("INSERT INTO main.tallies SELECT * FROM shard.tallies");
  transaction.commit();
  attach.reset();
  database.exec("DETACH shard");
}

/// Throws where an arm of the others has not all matches of this shard.
void check_arms_of(SQLite::Database& database, const ShardFile& file) {
  const MatchRange range = range_of(file.stamp.shard, static_cast<std::uint32_t>(file.stamp.matches));
  SQLite::Statement behind(database,
                           "SELECT name FROM arms AS a WHERE (SELECT count(*) FROM tallies AS t WHERE t.arm_id = "
                           "a.arm_id AND t.match_id >= ? AND t.match_id < ?) <> ? LIMIT 1");
  behind.bind(1, std::int64_t{range.begin});
  behind.bind(2, std::int64_t{range.end});
  behind.bind(3, std::int64_t{range.size()});
  if (!behind.executeStep()) return;
  throw refused_shard(file.path, fmt::format("shard {} has not all of its matches of {}, which other shards have: the "
                                             "command that began it goes on from there",
                                             file.stamp.shard.text(), behind.getColumn(0).getString()));
}

}  // namespace

bool any_is_tally_book(const std::vector<fs::path>& files) {
  return std::ranges::any_of(files, [](const fs::path& path) {
    try {
      const LogFile book(path, kTallyBook, Check::kSchema);
      return true;
    } catch (const std::exception&) {
      return false;  // merging says what is wrong with it
    }
  });
}

MergedBooks merge_books(const std::vector<fs::path>& files, const fs::path& to,
                        const std::function<bool(std::size_t, std::size_t)>& told) {
  std::vector<ShardFile> shards;
  shards.reserve(files.size());
  for (const fs::path& path : files) shards.push_back(read_book_shard(path));
  check_set(shards);
  const ShardStamp& whole = shards.front().stamp;
  MergedBooks merged{.shards = static_cast<std::int64_t>(shards.size()), .arms = 0, .matches = whole.matches};
  std::size_t done = 0;
  const auto goes_on = [&] { return told(done, shards.size()); };
  if (!goes_on()) throw Stopped{};
  const auto database = new_file(to, kTallyBook, [&](SQLite::Database& made) {
    made.exec("PRAGMA trusted_schema = OFF");
    create_book(made, {whole.arguments, whole.matches, true});
    stoppable(made, goes_on, [&] {
      for (const ShardFile& shard : shards) {
        copy_book_rows(made, shard.path);
        ++done;
      }
    });
    if (!goes_on()) throw Stopped{};
    for (const ShardFile& shard : shards) check_arms_of(made, shard);
    merged.arms = made.execAndGet("SELECT count(*) FROM arms").getInt64();
  });
  fold(*database);
  return merged;
}

}  // namespace trivela::evaluator::log
