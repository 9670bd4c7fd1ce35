#include "log/file/ball_turns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "kicking/geometry/time.hpp"
#include "log/file/kicked_tracks_of.sql.hpp"

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

}  // namespace trivela::log
