#include "log/merge/row_copy.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "log/file/files_beside.hpp"
#include "log/schema/row_digest.hpp"
#include "log/schema/schema.hpp"

namespace trivela::log {
namespace {

std::vector<std::string> names_of_columns(SQLite::Database& database, std::string_view table) {
  const auto schema = columns_of(database, table);
  std::vector<std::string> names;
  for (const Column& column : *schema) names.push_back(column.name);
  return names;
}

std::string insertion(std::string_view table, const std::vector<std::string>& columns) {
  const std::vector<std::string> places(columns.size(), "?");
  return fmt::format("INSERT INTO main.{} ({}) VALUES ({})", table, fmt::join(columns, ", "), fmt::join(places, ", "));
}

void bind_cell(SQLite::Statement& statement, int place, const Value& value) {
  if (const auto* const whole = std::get_if<std::int64_t>(&value)) return statement.bind(place, *whole);
  if (const auto* const number = std::get_if<double>(&value)) return statement.bind(place, *number);
  if (const auto* const text = std::get_if<std::string>(&value)) return statement.bindNoCopy(place, *text);
  if (const auto* const bytes = std::get_if<Blob>(&value))
    return statement.bindNoCopy(place, bytes->data(), static_cast<int>(bytes->size()));
  statement.bind(place);
}

}  // namespace

RowCopy::RowCopy(SQLite::Database& database, std::string_view table)
    : database_(database), columns_(names_of_columns(database, table)), insert_(database, insertion(table, columns_)) {}

std::size_t RowCopy::place(std::string_view column) const {
  return static_cast<std::size_t>(std::ranges::find(columns_, column) - columns_.begin());
}

bool RowCopy::insert(std::span<const Value> row) {
  insert_.tryReset();
  for (std::size_t i = 0; i < row.size(); ++i) bind_cell(insert_, static_cast<int>(i) + 1, row[i]);
  const int code = insert_.tryExecuteStep();
  insert_.tryReset();
  if (code == SQLITE_DONE) return true;
  const int primary = code & 0xFF;
  if (primary == SQLITE_CONSTRAINT || primary == SQLITE_MISMATCH) return false;
  throw SQLite::Exception(database_.getHandle(), code);
}

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
  const SQLite::Column rows =
      database.execAndGet(fmt::format("SELECT (SELECT row_count FROM main.digests WHERE session_id = {})", session_id));
  return rows.isNull() ? std::nullopt : std::optional{rows.getInt64()};
}

bool has_tallies(SQLite::Database& database, std::int64_t session_id) {
  constexpr const char* kAsked = "SELECT EXISTS (SELECT 1 FROM main.tallied_sessions WHERE session_id = {})";
  return database.execAndGet(fmt::format(kAsked, session_id)).getInt() != 0;
}

std::int64_t counted_rows(SQLite::Database& database, std::int64_t session_id) {
  constexpr const char* kAsked = "SELECT count(*) FROM main.{} WHERE session_id = {}";
  std::int64_t rows = 0;
  for (const DigestedTable& table : digested_tables())
    rows += database.execAndGet(fmt::format(kAsked, table.name, session_id)).getInt64();
  return rows;
}

}  // namespace trivela::log
