#include "log/read/timed_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <queue>
#include <utility>

#include "log/file/log_file.hpp"

namespace trivela::log {
namespace {

/// One part with the row that comes next.
class Cursor {
 public:
  Cursor(SQLite::Database& database, const TimedPart& part)
      : statement_(database,
                   fmt::format("SELECT {} FROM {} WHERE session_id = ?{} ORDER BY {}", fmt::join(part.columns, ", "),
                               part.table, part.robot_id ? " AND robot_id = ?" : "", part.key)),
        row_(part.columns.size()) {
    statement_.bind(1, part.session_id);
    if (part.robot_id) statement_.bind(2, *part.robot_id);
  }

  bool step() {
    if (!statement_.executeStep()) return false;
    for (std::size_t i = 0; i < row_.size(); ++i) row_[i] = value_of(statement_.getColumn(static_cast<int>(i)));
    return true;
  }

  std::span<const Value> row() const { return row_; }

 private:
  SQLite::Statement statement_;
  std::vector<Value> row_;
};

}  // namespace

void rows_in_time(SQLite::Database& database, const std::vector<TimedPart>& parts, const PartInstant& instant,
                  const PartRow& fn) {
  using Next = std::pair<std::int64_t, std::size_t>;  // instant, part
  std::priority_queue<Next, std::vector<Next>, std::greater<>> next;
  std::vector<std::unique_ptr<Cursor>> cursors;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    cursors.push_back(std::make_unique<Cursor>(database, parts[i]));
    if (cursors[i]->step()) next.emplace(instant(i, cursors[i]->row()), i);
  }
  while (!next.empty()) {
    const auto [t_ns, i] = next.top();
    next.pop();
    fn(i, t_ns, cursors[i]->row());
    if (cursors[i]->step()) next.emplace(instant(i, cursors[i]->row()), i);
  }
}

}  // namespace trivela::log
