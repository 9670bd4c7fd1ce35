#include "log/merge/merge_clocks.hpp"

#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>

#include <algorithm>

#include "log/schema/row_digest.hpp"

namespace trivela::log {
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
  for (const DigestedTable& table : digested_tables()) {
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
  SQLite::Statement query(
      database, fmt::format("SELECT uuid, started_t_ns, coalesce(closed_t_ns, (SELECT max(to_t_ns) FROM losses AS l "
                            "WHERE l.session_id = s.session_id AND l.robot_id = 0), started_t_ns), "
                            "realtime_offset_ns FROM sessions AS s WHERE session_id = {}",
                            session_id));
  ClockedSession clock{.session_id = session_id,
                       .uuid = "",
                       .robot_id = robot_of(database, session_id),
                       .started_t_ns = 0,
                       .ended_t_ns = 0,
                       .realtime_offset_ns = 0};
  if (!query.executeStep()) return clock;  // what could not be read of its row
  clock.uuid = query.getColumn(0).getString();
  clock.started_t_ns = query.getColumn(1).getInt64();
  clock.ended_t_ns = query.getColumn(2).getInt64();
  clock.realtime_offset_ns = query.getColumn(3).getInt64();
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
    for (const ClockSegment& segment : session.segments) {
      SQLite::bind(insert, session.session_id, segment.from_t_ns, segment.utc_offset_ns, segment.rate, segment.error_ns,
                   alignment.reference_uuid);
      insert.exec();
      insert.reset();
    }
  }
  return alignment;
}

}  // namespace trivela::log
