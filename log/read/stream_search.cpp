#include "log/read/stream_search.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <initializer_list>

#include "log/file/log_file.hpp"

namespace trivela::log {
namespace {

void ask(SQLite::Statement& statement, std::initializer_list<std::int64_t> numbers) {
  statement.reset();
  int place = 0;
  for (const std::int64_t number : numbers) statement.bind(++place, number);
}

}  // namespace

StreamSearch::StreamSearch(SQLite::Database& database, std::string_view table, const std::vector<std::string>& columns)
    // Each end by itself: asked for both at once, SQLite walks through all rows between them.
    : ends_(database, fmt::format("SELECT (SELECT min(seq) FROM {0} WHERE session_id = ?1 AND robot_id = ?2), "
                                  "(SELECT max(seq) FROM {0} WHERE session_id = ?1 AND robot_id = ?2)",
                                  table)),
      instant_(database, fmt::format("SELECT seq, t_ns FROM {} WHERE session_id = ? AND robot_id = ? AND seq >= ? "
                                     "ORDER BY seq LIMIT 1",
                                     table)),
      rows_(database, fmt::format("SELECT {} FROM {} WHERE session_id = ? AND robot_id = ? AND seq >= ? AND seq < ? "
                                  "AND t_ns >= ? AND t_ns <= ? ORDER BY seq",
                                  fmt::join(columns, ", "), table)) {}

// The first seq from which t_ns is no less; one past the last where there is none.
std::int64_t StreamSearch::first_from(const StreamSpan& span, std::int64_t t_ns) {
  ask(ends_, {span.session_id, span.robot_id});
  if (!ends_.executeStep() || ends_.getColumn(0).isNull()) return 0;
  std::int64_t low = ends_.getColumn(0).getInt64(), high = ends_.getColumn(1).getInt64() + 1;
  while (low < high) {
    const std::int64_t middle = low + (high - low) / 2;
    ask(instant_, {span.session_id, span.robot_id, middle});
    if (instant_.executeStep() && instant_.getColumn(1).getInt64() < t_ns) {
      low = instant_.getColumn(0).getInt64() + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

void StreamSearch::rows(const StreamSpan& span, const RowFunction& fn) {
  const std::int64_t from = first_from(span, span.from_t_ns), to = first_from(span, span.to_t_ns + 1);
  ask(rows_, {span.session_id, span.robot_id, from, to, span.from_t_ns, span.to_t_ns});
  std::vector<Value> row(static_cast<std::size_t>(rows_.getColumnCount()));
  while (rows_.executeStep()) {
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = value_of(rows_.getColumn(static_cast<int>(i)));
    fn(row);
  }
  for (SQLite::Statement* const asked : {&ends_, &instant_, &rows_})
    asked->reset();  // a statement under way holds its snapshot
}

}  // namespace trivela::log
