#include "tests/e2e/log_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace trivela::e2e {
namespace {

constexpr std::int64_t kWithoutSession = (std::int64_t{1} << 48) - 1;  // of a kick_id

std::vector<std::string> texts_of(const Reader& log, const std::string& sql) {
  std::vector<std::string> texts;
  for (const Row& row : rows_of(log, sql)) texts.push_back(std::get<std::string>(row[0]));
  return texts;
}

std::vector<std::string> columns_of(const Reader& log, const std::string& table) {
  return texts_of(log, fmt::format("SELECT name FROM pragma_table_info('{}')", table));
}

std::vector<std::string> tables_of(const Reader& log) {
  return texts_of(log, "SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY name");
}

std::string text_of(const Row& row) {
  std::vector<std::string> cells;
  for (const Value& value : row) {
    cells.push_back(std::visit(
        [](const auto& cell) -> std::string {
          if constexpr (std::is_same_v<std::remove_cvref_t<decltype(cell)>, std::monostate>) {
            return "NULL";
          } else {
            return fmt::format("{}", cell);
          }
        },
        value));
  }
  return fmt::format("{}", fmt::join(cells, " "));
}

// The rows of a table with what every recording of the same match has alike.
std::vector<Row> repeatable_rows(const Reader& log, const std::string& table) {
  if (table == "texts") return {};                                               // they say how the match was called
  if (table == "tallied_sessions") return {};                                    // it has the digest
  if (table == "digests") return rows_of(log, "SELECT row_count FROM digests");  // it covers the session's number
  if (table == "sessions") {
    return rows_of(
        log, "SELECT robot_id, started_t_ns, closed_t_ns, clock, seed, scenario, simulated, idl_sha256 FROM sessions");
  }
  std::vector<std::string> columns;
  for (const std::string& column : columns_of(log, table)) {
    if (column == "session_id") continue;
    columns.push_back(column.ends_with("kick_id") ? fmt::format("{} & {}", column, kWithoutSession) : column);
  }
  // The primary keys begin with session_id, so that this is their order.
  return rows_of(log, fmt::format("SELECT {} FROM {}", fmt::join(columns, ", "), table));
}

}  // namespace

std::vector<Row> rows_of(const Reader& log, const std::string& sql) {
  std::vector<Row> rows;
  log.query(sql, [&](std::span<const Value> row) { rows.emplace_back(row.begin(), row.end()); });
  return rows;
}

std::int64_t number_of(const Reader& log, const std::string& sql) {
  const auto rows = rows_of(log, sql);
  const auto* const number = std::get_if<std::int64_t>(&rows.at(0).at(0));
  return number != nullptr ? *number : 0;
}

double real_of(const Reader& log, const std::string& sql) {
  const auto rows = rows_of(log, sql);
  const auto* const number = std::get_if<double>(&rows.at(0).at(0));
  return number != nullptr ? *number : 0.0;
}

std::vector<std::string> streams_of(const Reader& log) {
  std::vector<std::string> streams;
  for (const std::string& table : tables_of(log)) {
    const auto columns = columns_of(log, table);
    const auto has = [&](const char* name) { return std::ranges::find(columns, name) != columns.end(); };
    if (has("seq") && !has("shadow_index")) streams.push_back(table);
  }
  return streams;
}

std::vector<std::string> gaps_of(const Reader& log) {
  std::vector<std::string> gaps;
  for (const std::string& stream : streams_of(log)) {
    for (const Row& row : rows_of(log, fmt::format("SELECT robot_id, min(seq), max(seq), count(*) FROM {} "
                                                   "GROUP BY session_id, robot_id HAVING min(seq) <> 1 OR max(seq) <> "
                                                   "count(*)",
                                                   stream))) {
      gaps.push_back(fmt::format("{}: robot, first, last, rows: {}", stream, text_of(row)));
    }
  }
  return gaps;
}

std::vector<std::string> losses_of(const Reader& log) {
  std::vector<std::string> losses;
  for (const Row& row : rows_of(log,
                                "SELECT stream, lost, gaps, overflow, nan_refused, rejected, out_of_order FROM "
                                "losses WHERE lost + gaps + overflow + nan_refused + rejected + out_of_order > 0")) {
    losses.push_back("lost, gaps, overflow, NaN, rejected, out of order: " + text_of(row));
  }
  return losses;
}

std::vector<std::string> loose_ends_of(const std::filesystem::path& log) {
  std::vector<std::string> ends;
  for (const char* const suffix : {"-wal", "-shm", "-journal"}) {
    if (std::filesystem::exists(log.string() + suffix))
      ends.push_back(fmt::format("{}{} is there", log.string(), suffix));
  }
  for (const auto& session : Reader{log}.sessions()) {
    if (!session.closed_t_ns) ends.push_back(fmt::format("session {} was not closed", session.uuid));
  }
  return ends;
}

std::vector<std::string> differences_of(const Reader& one, const Reader& other) {
  std::vector<std::string> differences;
  if (tables_of(one) != tables_of(other)) differences.push_back("other tables");
  for (const std::string& table : tables_of(one)) {
    const auto a = repeatable_rows(one, table);
    const auto b = repeatable_rows(other, table);
    const auto [in_a, in_b] = std::ranges::mismatch(a, b);
    if (in_a == a.end() && in_b == b.end()) continue;
    differences.push_back(fmt::format("{}, {} and {} rows, row {}:\n  {}\n  {}", table, a.size(), b.size(),
                                      in_a - a.begin(), in_a == a.end() ? "none" : text_of(*in_a),
                                      in_b == b.end() ? "none" : text_of(*in_b)));
  }
  return differences;
}

}  // namespace trivela::e2e
