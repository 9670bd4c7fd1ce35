#include "log/merge/merge_whole.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

#include "log/file/files_beside.hpp"
#include "log/schema/row_digest.hpp"
#include "log/schema/schema.hpp"

namespace trivela::log {

std::int64_t copy_whole(SQLite::Database& database, const std::filesystem::path& source,
                        const std::function<void(std::int64_t)>& told) {
  SQLite::Statement attach(database, "ATTACH ? AS whole");
  attach.bind(1, name_of_main_file(source));
  attach.exec();
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  std::int64_t rows = 0;
  for (const DigestedTable& table : digested_tables()) {
    std::vector<std::string> names;
    const auto columns = columns_of(database, table.name).value();
    names.reserve(columns.size());
    for (const Column& column : columns) names.push_back(column.name);
    rows += database.exec(fmt::format("INSERT OR IGNORE INTO main.{0} ({1}) SELECT {1} FROM whole.{0} ORDER BY {2}",
                                      table.name, fmt::join(names, ", "), table.key));
    told(rows);
  }
  // A row that was left out is found by the number alone: what is copied is copied as it is.
  const std::int64_t recorded = database.execAndGet("SELECT coalesce(sum(row_count), 0) FROM whole.digests").getInt64();
  if (rows == recorded) {
    database.exec("INSERT OR IGNORE INTO main.digests SELECT * FROM whole.digests");
    for (const std::string_view table : kTallies)
      database.exec(
          fmt::format("INSERT OR IGNORE INTO main.{0} SELECT * FROM whole.{0} WHERE session_id IN (SELECT "
                      "session_id FROM whole.tallied_sessions JOIN whole.digests USING (session_id, sha256))",
                      table));
  }
  transaction.commit();
  attach.reset();
  database.exec("DETACH whole");
  return rows;
}

std::optional<std::int64_t> rows_of_whole(SQLite::Database& database, std::int64_t session_id) {
  SQLite::Statement digest(database, "SELECT row_count FROM main.digests WHERE session_id = ?");
  digest.bind(1, session_id);
  if (!digest.executeStep()) return std::nullopt;
  return digest.getColumn(0).getInt64();
}

bool has_tallies(SQLite::Database& database, std::int64_t session_id) {
  SQLite::Statement tallied(database, "SELECT 1 FROM main.tallied_sessions WHERE session_id = ?");
  tallied.bind(1, session_id);
  return tallied.executeStep();
}

std::int64_t counted_rows(SQLite::Database& database, std::int64_t session_id) {
  std::int64_t rows = 0;
  for (const DigestedTable& table : digested_tables()) {
    SQLite::Statement count(database, fmt::format("SELECT count(*) FROM main.{} WHERE session_id = ?", table.name));
    count.bind(1, session_id);
    count.executeStep();
    rows += count.getColumn(0).getInt64();
  }
  return rows;
}

}  // namespace trivela::log
