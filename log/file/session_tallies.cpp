#include "log/file/session_tallies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "kicking/geometry/time.hpp"
#include "log/file/decisions_of.sql.hpp"
#include "log/file/driver_counts_of.sql.hpp"
#include "log/file/first_decisions_of.sql.hpp"
#include "log/file/kicked_tracks_of.sql.hpp"
#include "log/file/played_spans_of.sql.hpp"
#include "log/file/recorded_halves_of.sql.hpp"
#include "log/schema/bind.hpp"
#include "log/schema/queries.hpp"
#include "log/schema/row_digest.hpp"

namespace trivela::log {
namespace {

constexpr double kFlight_s = 3.0;
constexpr double kCameBack_m = 0.4;
constexpr double kJump_m = 1.3, kFastest_mps = 15.0;  // farther apart: another ball than the one kicked

/// Follows the ball after each release and notes how far forward it came where it came back.
class Turns {
 public:
  void release(std::int64_t session_id, std::int64_t t_ns) {
    end();
    session_id_ = session_id;
    release_t_ns_ = last_t_ns_ = t_ns;
    followed_ = true;
  }
  void seen(std::int64_t session_id, std::int64_t t_ns, double x_m, double y_m) {
    if (!followed_) return;
    const double apart_s = kicking::seconds(t_ns - last_t_ns_);
    const bool other_ball =
        sightings_ > 0 && std::hypot(x_m - last_x_m_, y_m - last_y_m_) > std::max(kJump_m, kFastest_mps * apart_s);
    if (session_id != session_id_ || other_ball || kicking::seconds(t_ns - release_t_ns_) > kFlight_s) return end();
    if (sightings_++ == 0) first_y_m_ = y_m;
    farthest_y_m_ = std::max(farthest_y_m_, y_m);
    last_t_ns_ = t_ns;
    last_x_m_ = x_m;
    last_y_m_ = y_m;
  }
  std::vector<BallTurn> all() {
    end();
    return std::move(turns_);
  }

 private:
  void end() {
    const bool went = farthest_y_m_ - first_y_m_ > kCameBack_m, came_back = farthest_y_m_ - last_y_m_ > kCameBack_m;
    if (followed_ && sightings_ > 0 && went && came_back) turns_.push_back({session_id_, farthest_y_m_});
    followed_ = false;
    sightings_ = 0;
    farthest_y_m_ = -HUGE_VAL;
  }

  std::vector<BallTurn> turns_;
  bool followed_ = false;
  std::int64_t session_id_ = 0, release_t_ns_ = 0, last_t_ns_ = 0, sightings_ = 0;
  double first_y_m_ = 0.0, last_x_m_ = 0.0, last_y_m_ = 0.0, farthest_y_m_ = -HUGE_VAL;
};

}  // namespace

std::vector<BallTurn> ball_turns(const Queries& rows, std::string_view wanted) {
  Turns turns;
  rows.query(fmt::format("WITH wanted (session_id) AS ({}) {}", wanted, kKickedTracksOfSql),
             [&](std::int64_t session_id, std::int64_t t_ns, std::optional<double> x_m, std::optional<double> y_m) {
               if (!x_m || !y_m) {
                 turns.release(session_id, t_ns);
               } else {
                 turns.seen(session_id, t_ns, *x_m, *y_m);
               }
             });
  return turns.all();
}

std::vector<double> ball_turns_of(const Queries& reader) {
  std::vector<double> turns_y_m;
  reader.query(
      "SELECT y_m FROM ball_turns WHERE session_id IN (SELECT session_id FROM counted_sessions) ORDER BY session_id, "
      "turn",
      [&](double y_m) { turns_y_m.push_back(y_m); });
  for (const BallTurn& turn : ball_turns(reader, "SELECT session_id FROM uncounted_sessions"))
    turns_y_m.push_back(turn.y_m);
  return turns_y_m;
}

namespace {

/// What is counted of the sessions that `wanted`, a SELECT, names, as a SELECT.
std::string counted(std::string_view wanted, std::string_view what) {
  return fmt::format("WITH wanted (session_id) AS ({}) {}", wanted, what);
}

/// Possessions with decisions, with play, or with both.
std::string possessions(std::string_view wanted) {
  return fmt::format(
      "SELECT session_id, robot_id, half, possession_id, counted_by, max(first_seq), sum(decisions), sum(fires), "
      "max(from_t_ns), max(to_t_ns), max(played_ns) FROM ("
      "SELECT session_id, robot_id, half, possession_id, 'robot' AS counted_by, first_seq, decisions, fires, "
      "NULL AS from_t_ns, NULL AS to_t_ns, NULL AS played_ns FROM ({}) UNION ALL "
      "SELECT session_id, robot_id, half, possession_id, CASE WHEN of_robot IS NULL THEN 'referee' ELSE 'robot' END, "
      "NULL, 0, 0, from_t_ns, to_t_ns, played_ns FROM ({})) "
      "GROUP BY session_id, robot_id, half, possession_id, counted_by",
      counted(wanted, kFirstDecisionsOfSql), counted(wanted, kPlayedSpansOfSql));
}

struct Tally {
  std::string_view table;
  std::string rows;  // SELECT of what it should have
};

/// All but the ball's turns, which no SELECT counts.
std::array<Tally, 4> tallies(std::string_view wanted) {
  return {Tally{"session_tallies", counted(wanted, kDecisionsOfSql)}, Tally{"possession_tallies", possessions(wanted)},
          Tally{"order_tallies", counted(wanted, kDriverCountsOfSql)},
          Tally{"referee_tallies", counted(wanted, kRecordedHalvesOfSql)}};
}

void write_turns(SQLite::Database& database, std::int64_t session_id, std::string_view wanted) {
  SQLite::Statement insert(database, "INSERT INTO main.ball_turns VALUES (?, ?, ?)");
  std::int64_t turn = 0;
  for (const BallTurn& found : ball_turns(OwnRows(database), wanted)) run(insert, session_id, turn++, found.y_m);
}

}  // namespace

void write_tallies(SQLite::Database& database, std::int64_t session_id) {
  for (const std::string_view table : kTallies)
    database.exec(fmt::format("DELETE FROM main.{} WHERE session_id = {}", table, session_id));
  SQLite::Statement of_experiment(database, "SELECT match_id IS NOT NULL FROM main.sessions WHERE session_id = ?");
  of_experiment.bind(1, session_id);
  if (!of_experiment.executeStep() || of_experiment.getColumn(0).getInt() != 0) return;
  const std::string wanted = fmt::format("SELECT {}", session_id);
  for (const Tally& tally : tallies(wanted))
    database.exec(fmt::format("INSERT INTO main.{} {}", tally.table, tally.rows));
  write_turns(database, session_id, wanted);
  database.exec(
      fmt::format("INSERT INTO main.tallied_sessions SELECT session_id, sha256 FROM main.digests WHERE "
                  "session_id = {}",
                  session_id));
}

void create_tally_views(SQLite::Database& database) {
  database.exec(
      "CREATE TEMP VIEW counted_sessions AS SELECT t.session_id FROM main.tallied_sessions AS t JOIN main.digests AS d "
      "ON d.session_id = t.session_id AND d.sha256 = t.sha256");
  database.exec(
      "CREATE TEMP VIEW uncounted_sessions AS SELECT session_id FROM sessions WHERE session_id NOT IN (SELECT "
      "session_id FROM counted_sessions)");
  constexpr std::string_view kCounted = "session_id IN (SELECT session_id FROM counted_sessions)";
  const auto view = [&](std::string_view name, std::string_view tallied, std::string_view rows) {
    database.exec(fmt::format("CREATE TEMP VIEW {} AS {} UNION ALL SELECT * FROM ({})", name, tallied,
                              counted("SELECT session_id FROM uncounted_sessions", rows)));
  };
  view("played_possessions",
       fmt::format("SELECT session_id, CASE counted_by WHEN 'robot' THEN robot_id END AS of_robot, robot_id, half, "
                   "possession_id, from_t_ns, to_t_ns, played_ns FROM possession_tallies WHERE from_t_ns IS NOT NULL "
                   "AND {}",
                   kCounted),
       kPlayedSpansOfSql);
  view("decided_possessions",
       fmt::format("SELECT session_id, robot_id, half, possession_id, first_seq, decisions, fires FROM "
                   "possession_tallies WHERE first_seq IS NOT NULL AND {}",
                   kCounted),
       kFirstDecisionsOfSql);
  view("driver_counts", fmt::format("SELECT * FROM order_tallies WHERE {}", kCounted), kDriverCountsOfSql);
  view("recorded_halves", fmt::format("SELECT * FROM referee_tallies WHERE {}", kCounted), kRecordedHalvesOfSql);
}

std::vector<std::string> wrong_tallies(const LogFile& file) {
  std::vector<std::string> sentences;
  std::set<std::pair<std::int64_t, std::string_view>> wrong;
  constexpr std::string_view kWanted = "SELECT session_id FROM counted_sessions";
  for (const Tally& tally : tallies(kWanted)) {
    const std::string noted = fmt::format("SELECT * FROM main.{} WHERE session_id IN ({})", tally.table, kWanted);
    for (const auto& [a, b] : {std::pair{tally.rows, noted}, std::pair{noted, tally.rows}})
      file.query(fmt::format("SELECT DISTINCT session_id FROM (SELECT * FROM ({}) EXCEPT SELECT * FROM ({}))", a, b),
                 [&](std::int64_t session_id) { wrong.emplace(session_id, tally.table); });
  }
  std::vector<std::pair<std::int64_t, double>> noted, counted_now;
  file.query(
      fmt::format("SELECT session_id, y_m FROM main.ball_turns WHERE session_id IN ({}) ORDER BY session_id, turn",
                  kWanted),
      [&](std::int64_t session_id, double y_m) { noted.emplace_back(session_id, y_m); });
  for (const BallTurn& turn : ball_turns(file, kWanted)) counted_now.emplace_back(turn.session_id, turn.y_m);
  if (noted != counted_now) {
    const auto& longer = noted.size() > counted_now.size() ? noted : counted_now;
    const auto& other = &longer == &noted ? counted_now : noted;
    for (std::size_t i = 0; i < longer.size(); ++i)
      if (i >= other.size() || longer[i] != other[i]) wrong.emplace(longer[i].first, "ball_turns");
  }
  for (const auto& [session_id, table] : wrong)
    file.query(fmt::format("SELECT uuid FROM main.sessions WHERE session_id = {}", session_id),
               [&, name = table](const std::string& uuid) {
                 sentences.push_back(fmt::format("{} of session {} does not count its rows", name, uuid));
               });
  return sentences;
}

}  // namespace trivela::log
