#include "log/read/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <queue>
#include <stdexcept>
#include <utility>

#include "log/file/log_file.hpp"
#include "log/file/session_tallies.hpp"
#include "log/schema/bind.hpp"
#include "log/schema/row_digest.hpp"

namespace trivela::log {
namespace {

constexpr std::int64_t kMostHeldKicks = 100'000;  // some 40 MB

std::optional<RecordedOutcome> crossing_of(const std::optional<std::string>& outcome, std::optional<double> x_cross_m,
                                           std::optional<double> z_cross_m) {
  if (!outcome) return std::nullopt;
  return RecordedOutcome{*outcome, x_cross_m, z_cross_m};
}

void ask(SQLite::Statement& statement, std::initializer_list<std::int64_t> numbers) {
  statement.reset();
  int place = 0;
  for (const std::int64_t number : numbers) statement.bind(++place, number);
}

}  // namespace

/// Finds rows of a stream by their instant, which has no index, through the key of session, robot and seq.
class StreamSearch {
 public:
  /// `table` and `columns` are there.
  StreamSearch(SQLite::Database& database, std::string_view table, const std::vector<std::string>& columns)
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

  void rows(const StreamSpan& span, const RowFunction& fn) {
    const std::int64_t from = first_from(span, span.from_t_ns), to = first_from(span, span.to_t_ns + 1);
    ask(rows_, {span.session_id, span.robot_id, from, to, span.from_t_ns, span.to_t_ns});
    each_row_of(rows_, {}, fn);
    for (SQLite::Statement* const asked : {&ends_, &instant_, &rows_})
      asked->reset();  // a statement under way holds its snapshot
  }

 private:
  // The first seq from which t_ns is no less; one past the last where there is none.
  std::int64_t first_from(const StreamSpan& span, std::int64_t t_ns) {
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

  SQLite::Statement ends_;     // first and last seq of a session and robot
  SQLite::Statement instant_;  // seq and t_ns of the row with a seq, or of the next one
  SQLite::Statement rows_;
};

namespace {

/// One part of a table with the row that comes next.
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

}  // namespace

struct Reader::Impl {
  Impl(const std::filesystem::path& path, Check check) : file(path, kMatchLog, check) {
    create_reading_views(file.database());
    create_tally_views(file.database());
    if (file.may_be_damaged()) return;
    file.query("BEGIN", [](auto) {});  // a log may grow meanwhile
    check_texts(file);
    verification = file.looks_at_everything() ? verify(file) : unverified(file);
    file.query("COMMIT", [](auto) {});
  }

  void check_columns(std::string_view table, const std::vector<std::string>& columns) const;

  LogFile file;
  Verification verification;
  bool holds_kicks = false;
  std::map<std::string, StreamSearch, std::less<>> streams;  // by table and columns; before the file goes, they go
};

Reader::Reader(const std::filesystem::path& path, Check check) : impl_(std::make_unique<Impl>(path, check)) {}
Reader::~Reader() = default;

const Verification& Reader::verification() const { return impl_->verification; }

bool Reader::is_whole(std::int64_t session_id) const { return log::is_whole(impl_->file, session_id); }

std::optional<std::string> Reader::doubt() const {
  const Verification& found = impl_->verification;
  if (!found.compared && found.rows > 0)
    return fmt::format("not verified: {} rows; trivela report --verify", found.rows);
  if (found.without_digest > 0)
    return fmt::format("not verified: {} that never ended and so {} no digest",
                       found.without_digest == 1 ? "a session" : fmt::format("{} sessions", found.without_digest),
                       found.without_digest == 1 ? "has" : "have");
  return std::nullopt;
}

void Reader::hold_kicks() const {
  if (std::exchange(impl_->holds_kicks, true)) return;
  SQLite::Database& database = impl_->file.database();
  impl_->file.as_query([&] {
    if (database.execAndGet("SELECT count(*) FROM kick_decisions WHERE fire = 1").getInt64() > kMostHeldKicks) return;
    // By the view's own name, which the others go by.
    database.exec(
        "CREATE TEMP TABLE put_together AS SELECT * FROM temp.kicks; DROP VIEW temp.kicks; "
        "CREATE TEMP TABLE kicks AS SELECT * FROM temp.put_together; DROP TABLE temp.put_together; "
        "CREATE INDEX temp.kicks_key ON kicks (session_id, robot_id, kick_id)");
  });
}

std::vector<GivenLabel> Reader::labels() const {
  using L = GivenLabel;
  return rows<L>(
      "SELECT s.uuid, l.robot_id, l.kick_id, l.utc_ns, l.who, l.t_ns, l.outcome, l.note FROM main.labels AS l "
      "JOIN main.sessions AS s ON s.session_id = l.session_id",
      &L::uuid, &L::robot_id, &L::kick_id, &L::utc_ns, &L::who, &L::t_ns, &L::outcome, &L::note);
}

void Reader::read_labels(const std::vector<GivenLabel>& labels) {
  SQLite::Statement insert(impl_->file.database(), "INSERT INTO temp.labels_elsewhere VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  for (const GivenLabel& label : labels)
    run(insert, label.uuid, label.robot_id, label.kick_id, label.utc_ns, label.who, label.t_ns, label.outcome,
        label.note);
}

void Reader::leave_out(const std::vector<std::int64_t>& session_ids, const std::vector<RecordedKick>& kicks) {
  SQLite::Database& database = impl_->file.database();
  SQLite::Statement session(database, "INSERT OR IGNORE INTO temp.left_out_sessions VALUES (?)");
  for (const std::int64_t session_id : session_ids) run(session, session_id);
  SQLite::Statement insert(database, "INSERT OR IGNORE INTO temp.left_out_kicks VALUES (?, ?, ?)");
  for (const RecordedKick& kick : kicks) run(insert, kick.session_id, kick.robot_id, kick.kick_id);
}

void Reader::each_row(std::string_view sql, const HeadFunction& head, const RowFunction& fn) const {
  impl_->file.each_row(sql, head, fn);
}

void Reader::ask(const std::string& sql, const HeadFunction& head, const RowFunction& fn) const {
  impl_->file.ask(sql, head, fn);
}

void Reader::Impl::check_columns(std::string_view table, const std::vector<std::string>& columns) const {
  const auto schema = columns_of(file.database(), table);
  if (!schema) throw std::runtime_error(fmt::format("the match log {} has no table '{}'", file.path(), table));
  for (const std::string& column : columns) {
    if (std::ranges::find(*schema, column, &Column::name) != schema->end()) continue;
    throw std::runtime_error(fmt::format("table '{}' of {} has no column '{}'", table, file.path(), column));
  }
}

void Reader::for_each_row_between(std::string_view table, const std::vector<std::string>& columns,
                                  const StreamSpan& span, const RowFunction& fn) const {
  const std::string key = fmt::format("{}:{}", table, fmt::join(columns, ","));
  auto stream = impl_->streams.find(key);
  if (stream == impl_->streams.end()) {
    impl_->check_columns(table, columns);
    stream = impl_->streams.try_emplace(key, impl_->file.database(), table, columns).first;
  }
  try {
    impl_->file.as_query([&] { stream->second.rows(span, fn); });
  } catch (const WrongCell& wrong) {
    throw std::runtime_error(fmt::format("cannot read the match log {}: column {} of {} is not {}", impl_->file.path(),
                                         columns.at(wrong.column), table, wrong.wanted));
  }
}

void Reader::for_each_row_in_time(const std::vector<TimedPart>& parts, const PartInstant& instant,
                                  const PartRow& fn) const {
  try {
    impl_->file.as_query([&] { rows_in_time(impl_->file.database(), parts, instant, fn); });
  } catch (const WrongCell& wrong) {
    throw std::runtime_error(fmt::format("cannot read the match log {}: column {} of a table is not {}",
                                         impl_->file.path(), wrong.column + 1, wrong.wanted));
  }
}

std::vector<int> Reader::robots_in(std::string_view table, std::int64_t session_id) const {
  std::vector<int> robots;
  query(fmt::format("WITH RECURSIVE robots (id) AS ("
                    "SELECT (SELECT min(robot_id) FROM {0} WHERE session_id = {1}) UNION ALL "
                    "SELECT (SELECT min(robot_id) FROM {0} WHERE session_id = {1} AND robot_id > id) FROM robots "
                    "WHERE id IS NOT NULL) SELECT id FROM robots WHERE id IS NOT NULL",
                    table, session_id),
        [&](int robot_id) { robots.push_back(robot_id); });
  return robots;
}

std::vector<RecordedSession> Reader::sessions() const {
  using S = RecordedSession;
  auto sessions = rows<S>(
      "SELECT session_id, uuid, robot_id, started_t_ns, closed_t_ns, clock = 'simulated', realtime_offset_ns, "
      "idl_sha256, config_sha256, seed, software_version, scenario, simulated, nullif(arm, ''), "
      "nullif(kicker_table, ''), match_id, coalesce(continues_uuid, ''), coalesce(replays_uuid, ''), paired_halves, "
      "planned_s, calibration_id FROM sessions ORDER BY started_t_ns, session_id",
      &S::session_id, &S::uuid, &S::robot_id, &S::started_t_ns, &S::closed_t_ns, &S::simulated_clock,
      &S::realtime_offset_ns, &S::idl_sha256, &S::config_sha256, &S::seed, &S::software_version, &S::scenario,
      &S::simulated, &S::arm, &S::kicker_table, &S::match_id, &S::continues_uuid, &S::replays_uuid, &S::paired_halves,
      &S::planned_s, &S::calibration_id);
  query("SELECT session_id, half, policy, robot_id FROM session_policies ORDER BY session_id, robot_id, half",
        [&](std::int64_t session_id, int half, const std::string& policy, int robot_id) {
          const auto session = std::ranges::find(sessions, session_id, &S::session_id);
          if (session != sessions.end()) session->policies.push_back({half, policy, robot_id});
        });
  return sessions;
}

RecordedSession Reader::whole(RecordedSession session) const {
  query(fmt::format(
            "SELECT config.text, idl.text FROM sessions LEFT JOIN texts AS config ON config.sha256 = config_sha256 "
            "LEFT JOIN texts AS idl ON idl.sha256 = idl_sha256 WHERE session_id = {}",
            session.session_id),
        [&](std::optional<std::string> config_toml, std::optional<std::string> idl) {
          session.config_toml = std::move(config_toml).value_or("");
          session.idl = std::move(idl).value_or("");
        });
  return session;
}

std::vector<Kick> Reader::kicks() const {
  std::vector<Kick> kicks;
  query(
      "SELECT session_id, robot_id, kick_id, t_ns, half, possession_id, policy, order_seq, accepted, refusal, outcome, "
      "x_cross_m, z_cross_m, sd_cross_m, truth_outcome, truth_x_cross_m, truth_z_cross_m, truth_margin_m FROM kicks "
      "ORDER BY session_id, t_ns, robot_id",
      [&](const NamedCells& row) {
        kicks.push_back({.session_id = row.get<std::int64_t>("session_id"),
                         .robot_id = row.get<int>("robot_id"),
                         .kick_id = row.get<std::int64_t>("kick_id"),
                         .t_ns = row.get<std::int64_t>("t_ns"),
                         .half = row.get<int>("half"),
                         .possession_id = row.get<std::int64_t>("possession_id"),
                         .policy = row.get<std::string>("policy"),
                         .ordered = row.find<std::int64_t>("order_seq").has_value(),
                         .accepted = row.find<bool>("accepted"),
                         .refusal = row.find<std::string>("refusal").value_or(""),
                         .observed = crossing_of(row.find<std::string>("outcome"), row.find<double>("x_cross_m"),
                                                 row.find<double>("z_cross_m")),
                         .sd_cross_m = row.find<double>("sd_cross_m"),
                         .truth = crossing_of(row.find<std::string>("truth_outcome"),
                                              row.find<double>("truth_x_cross_m"), row.find<double>("truth_z_cross_m")),
                         .truth_margin_m = row.find<double>("truth_margin_m")});
      });
  return kicks;
}

std::vector<Loss> Reader::losses() const {
  return rows<Loss>(
      "SELECT stream, sum(received), sum(lost), sum(gaps), sum(overflow), sum(nan_refused), sum(rejected), "
      "sum(out_of_order) FROM losses GROUP BY stream ORDER BY stream",
      &Loss::stream, &Loss::received, &Loss::lost, &Loss::gaps, &Loss::overflow, &Loss::nan_refused, &Loss::rejected,
      &Loss::out_of_order);
}

Wal Reader::wal() const { return impl_->file.wal(); }

std::string Reader::not_closed() const { return impl_->file.not_closed(); }

std::vector<std::string> Reader::warnings() const {
  std::vector<std::string> warnings;
  for (const RecordedSession& session : sessions()) {
    if (session.closed_t_ns) continue;
    warnings.push_back(fmt::format("session {} was not closed: {}", session.uuid, impl_->file.not_closed()));
  }
  for (const Loss& loss : losses()) {
    if (loss.missing() > 0) warnings.push_back(fmt::format("{}: {} rows are missing", loss.stream, loss.missing()));
  }
  return warnings;
}

}  // namespace trivela::log
