#include "log/merge/merged_log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "log/file/files_beside.hpp"
#include "log/file/log_file.hpp"
#include "log/schema/bind.hpp"
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
  for (const StreamTable& table : digested_tables()) {
    rows += database.exec(fmt::format("INSERT OR IGNORE INTO main.{0} ({1}) SELECT {1} FROM whole.{0} ORDER BY {2}",
                                      table.name, fmt::join(names_of_columns(database, table.name), ", "), table.key));
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
  for (const StreamTable& table : digested_tables())
    rows += database.execAndGet(fmt::format(kAsked, table.name, session_id)).getInt64();
  return rows;
}

namespace {

std::optional<std::int64_t> only_number(SQLite::Database& database, const std::string& sql) {
  SQLite::Statement query(database, sql);
  if (!query.executeStep() || query.getColumn(0).isNull()) return std::nullopt;
  const std::int64_t number = query.getColumn(0).getInt64();
  if (query.executeStep()) return std::nullopt;
  return number;
}

int robot_of(SQLite::Database& database, std::int64_t session_id) {
  const auto named =
      only_number(database, fmt::format("SELECT robot_id FROM sessions WHERE session_id = {}", session_id));
  if (named) return static_cast<int>(*named);
  for (const char* const table : {"clock_offsets", "world_states", "kicker_status", "kick_decisions"}) {
    // Least and greatest by the key: no walk through all rows.
    SQLite::Statement query(database, fmt::format("SELECT (SELECT min(robot_id) FROM {0} WHERE session_id = {1}), "
                                                  "(SELECT max(robot_id) FROM {0} WHERE session_id = {1})",
                                                  table, session_id));
    query.executeStep();
    if (query.getColumn(0).isNull()) continue;
    const int least = query.getColumn(0).getInt(), greatest = query.getColumn(1).getInt();
    return least == greatest ? least : 0;
  }
  return 0;
}

std::vector<ClockOffset> offsets_of(SQLite::Database& database) {
  SQLite::Statement query(database,
                          "SELECT session_id, robot_id, other_robot_id, t_ns, offset_ns, error_ns FROM clock_offsets "
                          "ORDER BY session_id, robot_id, other_robot_id, t_ns");
  std::vector<ClockOffset> offsets;
  while (query.executeStep()) {
    offsets.push_back({query.getColumn(0).getInt64(), query.getColumn(1).getInt(), query.getColumn(2).getInt(),
                       query.getColumn(3).getInt64(), query.getColumn(4).getInt64(),
                       std::max<std::int64_t>(query.getColumn(5).getInt64(), 0)});
  }
  return offsets;
}

}  // namespace

std::int64_t missing_rows(SQLite::Database& database, std::int64_t session_id) {
  std::int64_t missing = 0;
  for (const StreamTable& table : digested_tables()) {
    const auto recorded = only_number(
        database, fmt::format("SELECT received - overflow - nan_refused - rejected FROM losses WHERE session_id = {} "
                              "AND stream = '{}' AND robot_id = 0",
                              session_id, table.name));
    if (!recorded) continue;
    const auto there =
        only_number(database, fmt::format("SELECT count(*) FROM {} WHERE session_id = {}", table.name, session_id));
    missing += std::max<std::int64_t>(*recorded - there.value_or(0), 0);
  }
  return missing;
}

ClockedSession clock_of(SQLite::Database& database, std::int64_t session_id) {
  using C = ClockedSession;
  auto found = OwnRows(database).rows<C>(
      fmt::format("SELECT uuid, started_t_ns, coalesce(closed_t_ns, (SELECT max(to_t_ns) FROM losses AS l WHERE "
                  "l.session_id = s.session_id AND l.robot_id = 0), started_t_ns), realtime_offset_ns FROM sessions "
                  "AS s WHERE session_id = {}",
                  session_id),
      &C::uuid, &C::started_t_ns, &C::ended_t_ns, &C::realtime_offset_ns);
  ClockedSession clock = found.empty() ? C{} : std::move(found.front());  // none: its row could not be read
  clock.session_id = session_id;
  clock.robot_id = robot_of(database, session_id);
  return clock;
}

Alignment write_clocks(SQLite::Database& database, const std::vector<MergedSession>& sessions,
                       std::optional<int> reference_robot) {
  std::vector<ClockedSession> clocks;
  clocks.reserve(sessions.size());
  for (const MergedSession& session : sessions) clocks.push_back(session.clock);
  Alignment alignment = align_clocks(clocks, offsets_of(database), reference_robot);
  SQLite::Statement insert(database,
                           "INSERT INTO session_clocks (session_id, from_t_ns, utc_offset_ns, rate, error_ns, "
                           "reference_uuid) VALUES (?, ?, ?, ?, ?, ?)");
  for (const AlignedSession& session : alignment.sessions) {
    for (const ClockSegment& segment : session.segments)
      run(insert, session.session_id, segment.from_t_ns, segment.utc_offset_ns, segment.rate, segment.error_ns,
          alignment.reference_uuid);
  }
  return alignment;
}

}  // namespace trivela::log
