#include "evaluator/timeline/kick_timeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "evaluator/metrics/listed_kicks.sql.hpp"
#include "evaluator/sessions/session_facts.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/outcome/opponents.hpp"

namespace trivela::evaluator {
namespace {

using kicking::Pose;
using Values = std::span<const log::Value>;

// How far a replay goes from the decision, and how fine it is.
constexpr double kBefore_s = 1.5, kLongest_s = 6.0, kStep_s = 0.04;
constexpr double kAfter_s = 0.3;                                // what settled the kick
constexpr double kUnsettled_s = 2.0;                            // where nothing did
constexpr double kRobotJump_m = 0.5, kFastestRobot_mps = 10.0;  // what is farther apart was not driven

std::optional<double> seconds_after(std::int64_t t_ns, std::optional<std::int64_t> then_ns) {
  if (!then_ns || *then_ns <= 0) return std::nullopt;  // 0: never
  return kicking::seconds(*then_ns - t_ns);
}

/// None: nobody said how the kick ended.
std::optional<TimelineEnd> end_of(const std::optional<std::string>& outcome, std::optional<double> x_m,
                                  std::optional<double> z_m, std::optional<double> sd_m = {},
                                  std::optional<double> after_s = {}) {
  if (!outcome) return std::nullopt;
  return TimelineEnd{*outcome, x_m, z_m, sd_m, after_s};
}

/// The kicks with what their decision, receipt and outcome say.
std::vector<KickTimeline> listed_kicks(const log::Reader& reader) {
  std::vector<KickTimeline> timelines;
  reader.query(kListedKicksSql, [&](const log::NamedCells& row) {
    const auto t_ns = row.get<std::int64_t>("t_ns");
    const auto distance_m = row.get<double>("distance_m");
    const auto predicted_x_m = row.find<double>("predicted_x_cross_m");
    const auto predicted_z_m = row.find<double>("predicted_z_cross_m");
    const auto flight_s = row.find<double>("predicted_t_flight_s");
    KickTimeline& timeline = timelines.emplace_back();
    timeline.session_id = row.get<std::int64_t>("session_id");
    timeline.robot_id = row.get<int>("robot_id");
    timeline.kick_id = row.get<std::int64_t>("kick_id");
    timeline.number = row.get<std::int64_t>("number");
    timeline.t_ns = t_ns;
    timeline.utc_ns = row.get<std::int64_t>("utc_ns");
    timeline.half = row.get<int>("half");
    timeline.policy = row.get<std::string>("policy");
    timeline.distance_m = distance_m;
    timeline.power = row.find<double>("power");
    timeline.robot = {row.get<double>("x_m"), row.get<double>("y_m"), row.get<double>("heading_rad")};
    timeline.target_m = {row.get<double>("target_x_m"), row.get<double>("target_y_m")};
    timeline.bounced = row.find<bool>("bounced");
    timeline.saved = row.find<bool>("saved");
    timeline.kick_kind = row.get<int>("kick_kind");
    timeline.segments = decided_segments({timeline.robot, row.get<double>("alpha_rad"), timeline.target_m, distance_m,
                                          row.get<bool>("aligned"), row.find<double>("offset_right_m"),
                                          row.get<double>("left_m"), row.get<double>("right_m")});
    timeline.fired_after_s = seconds_after(t_ns, row.find<std::int64_t>("fired_t_ns"));
    timeline.released_after_s = seconds_after(t_ns, row.find<std::int64_t>("release_t_ns"));
    if (predicted_x_m || predicted_z_m) {
      timeline.predicted = TimelineEnd{"", predicted_x_m, predicted_z_m, {}, {}};
      if (flight_s) timeline.predicted->after_s = timeline.released_after_s.value_or(0.0) + *flight_s;
    }
    timeline.observed =
        end_of(row.find<std::string>("outcome"), row.find<double>("x_cross_m"), row.find<double>("z_cross_m"),
               row.find<double>("sd_cross_m"), seconds_after(t_ns, row.find<std::int64_t>("settled_t_ns")));
    timeline.truth = end_of(row.find<std::string>("truth_outcome"), row.find<double>("truth_x_cross_m"),
                            row.find<double>("truth_z_cross_m"));
  });
  return timelines;
}

/// Streams of one kick's robot around the kick.
class KickStreams {
 public:
  explicit KickStreams(const log::Reader& reader) : reader_(reader) {}

  void fill(KickTimeline& timeline) {
    from_ns_ = timeline.t_ns - kicking::nanoseconds(kBefore_s);
    double end_s = kUnsettled_s;
    if (timeline.observed && timeline.observed->after_s) end_s = *timeline.observed->after_s + kAfter_s;
    to_ns_ = timeline.t_ns + kicking::nanoseconds(std::clamp(end_s, 0.0, kLongest_s));
    read_world(timeline);
    read_flight(timeline);
    read_opponent(timeline);
    read_others(timeline);
    add_half_time(reader_, timeline);
  }

 private:
  template <class Row>
  void rows(const KickTimeline& timeline, const char* table, const std::vector<std::string>& columns,
            std::int64_t from_ns, Row&& row) const {
    reader_.for_each_row_between(table, columns, {timeline.session_id, timeline.robot_id, from_ns, to_ns_}, row);
  }

  /// Whether a sample at this instant is the first of its step.
  bool begins_step(std::int64_t t_ns, std::optional<std::int64_t>& last) const {
    const auto step = (t_ns - from_ns_) / kicking::nanoseconds(kStep_s);
    return std::exchange(last, step) != step;
  }

  void read_world(KickTimeline& timeline) {
    world_.clear();
    std::vector<TimelinePlace> ball;
    rows(timeline, "world_states", {"t_ns", "x_m", "y_m", "heading_rad", "ball_known", "ball_x_m", "ball_y_m"},
         from_ns_, [&](Values cells) {
           const auto t_ns = log::cell_as<std::int64_t>(cells[0], 0) - timeline.t_ns;
           world_.push_back({t_ns,
                             {log::cell_as<double>(cells[1], 1), log::cell_as<double>(cells[2], 2),
                              log::cell_as<double>(cells[3], 3)}});
           const auto x_m = log::cell_as<std::optional<double>>(cells[5], 5);
           const auto y_m = log::cell_as<std::optional<double>>(cells[6], 6);
           if (log::cell_as<bool>(cells[4], 4) && x_m && y_m) ball.push_back({t_ns, {*x_m, *y_m, 0.0}});
         });
    cut_at_jumps(timeline);
    std::optional<std::int64_t> step;
    for (const TimelinePose& at : world_) {
      if (begins_step(timeline.t_ns + at.t_ns, step)) timeline.path.push_back(at);
    }
    step.reset();
    for (const TimelinePlace& at : ball) {
      const std::int64_t t_ns = timeline.t_ns + at.t_ns;
      if (t_ns >= from_ns_ && t_ns <= to_ns_ && begins_step(t_ns, step)) timeline.ball.push_back(at);
    }
  }

  /// Nobody drives like that: a simulator's next possession, or a robot that was carried. The timeline is of what lies
  /// between two jumps.
  void cut_at_jumps(const KickTimeline& timeline) {
    const auto jumps = [](const TimelinePose& a, const TimelinePose& b) {
      const double apart_m = std::hypot(b.pose.x_m - a.pose.x_m, b.pose.y_m - a.pose.y_m);
      return apart_m > std::max(kRobotJump_m, kFastestRobot_mps * kicking::seconds(b.t_ns - a.t_ns));
    };
    const auto decided = std::ranges::upper_bound(world_, std::int64_t{0}, {}, &TimelinePose::t_ns);
    const auto end = std::adjacent_find(decided == world_.begin() ? decided : std::prev(decided), world_.end(), jumps);
    if (end != world_.end()) to_ns_ = timeline.t_ns + end->t_ns;
    const auto before = std::adjacent_find(std::make_reverse_iterator(decided), world_.rend(),
                                           [&](const TimelinePose& b, const TimelinePose& a) { return jumps(a, b); });
    if (before != world_.rend()) from_ns_ = timeline.t_ns + before->t_ns;
    std::erase_if(world_, [&](const TimelinePose& at) {
      return timeline.t_ns + at.t_ns < from_ns_ || timeline.t_ns + at.t_ns > to_ns_;
    });
  }

  void read_flight(KickTimeline& timeline) const {
    std::optional<std::int64_t> step;
    rows(timeline, "flight_frames", {"t_exposure_ns", "ball_seen", "ball_x_m", "ball_y_m", "ball_z_m"}, timeline.t_ns,
         [&](Values cells) {
           const auto t_ns = log::cell_as<std::int64_t>(cells[0], 0);
           const auto x_m = log::cell_as<std::optional<double>>(cells[2], 2);
           const auto y_m = log::cell_as<std::optional<double>>(cells[3], 3);
           const auto z_m = log::cell_as<std::optional<double>>(cells[4], 4);
           if (log::cell_as<bool>(cells[1], 1) && x_m && y_m && z_m && t_ns >= timeline.t_ns && begins_step(t_ns, step))
             timeline.flight.push_back({t_ns - timeline.t_ns, {*x_m, *y_m, *z_m}});
         });
  }

  /// As known at the decision.
  void read_others(KickTimeline& timeline) const {
    std::vector<std::string> columns{"keeper_x_m", "opponent_count"};
    for (std::size_t i = 0; i < kicking::kMostBodies; ++i) {
      columns.push_back(fmt::format("opponent_x_{}_m", i));
      columns.push_back(fmt::format("opponent_y_{}_m", i));
    }
    bool first = true;
    rows(timeline, "world_states", columns, timeline.t_ns, [&](Values cells) {
      if (!std::exchange(first, false)) return;
      timeline.keeper_x_m = log::cell_as<std::optional<double>>(cells[0], 0);
      const auto count = static_cast<std::size_t>(log::cell_as<std::int64_t>(cells[1], 1));
      for (std::size_t i = 0; i < std::min(count, kicking::kMostBodies); ++i) {
        const auto x_m = log::cell_as<std::optional<double>>(cells[2 + 2 * i], 2 + 2 * i);
        const auto y_m = log::cell_as<std::optional<double>>(cells[3 + 2 * i], 3 + 2 * i);
        if (x_m && y_m) timeline.others.emplace_back(*x_m, *y_m);
      }
    });
  }

  /// In R of the pose at the exposure's instant.
  void read_opponent(KickTimeline& timeline) const {
    if (world_.empty()) return;
    std::optional<std::int64_t> step;
    rows(timeline, "vision_frames", {"t_exposure_ns", "opponent_seen", "opponent_x_m", "opponent_y_m"}, from_ns_,
         [&](Values cells) {
           const auto t_ns = log::cell_as<std::int64_t>(cells[0], 0);
           const auto x_m = log::cell_as<std::optional<double>>(cells[2], 2);
           const auto y_m = log::cell_as<std::optional<double>>(cells[3], 3);
           if (!log::cell_as<bool>(cells[1], 1) || !x_m || !y_m || t_ns < from_ns_ || !begins_step(t_ns, step)) return;
           const Eigen::Vector2d place = kicking::to_field(nearest_pose(t_ns - timeline.t_ns), {*x_m, *y_m});
           timeline.opponent.push_back({t_ns - timeline.t_ns, {place.x(), place.y(), 0.0}});
         });
  }

  const Pose& nearest_pose(std::int64_t t_ns) const {
    const auto after = std::ranges::lower_bound(world_, t_ns, {}, &TimelinePose::t_ns);
    if (after == world_.end()) return world_.back().pose;
    if (after == world_.begin()) return after->pose;
    const auto before = std::prev(after);
    return t_ns - before->t_ns < after->t_ns - t_ns ? before->pose : after->pose;
  }

  const log::Reader& reader_;
  std::int64_t from_ns_ = 0, to_ns_ = 0;
  std::vector<TimelinePose> world_;  // every row of the timeline's time
};

}  // namespace

std::vector<KickTimeline> kicks_without_tracks(const log::Reader& reader) {
  std::map<std::int64_t, LoggedPitch> pitches;
  for (const log::RecordedSession& session : reader.sessions())
    pitches[session.session_id] = pitch_of(reader.whole(session).config_toml);
  std::vector<KickTimeline> timelines = listed_kicks(reader);
  for (KickTimeline& timeline : timelines) {
    timeline.goal = pitches[timeline.session_id].goal;
    timeline.side_line_x_m = pitches[timeline.session_id].side_line_x_m;
  }
  return timelines;
}

void add_half_time(const log::Reader& reader, KickTimeline& timeline) {
  constexpr double kWord_s = 1.0;  // within which the referee says it again
  reader.for_each_row_between(
      "referee", {"t_ns", "half", "half_time_s"},
      {timeline.session_id, timeline.robot_id, timeline.t_ns - kicking::nanoseconds(kWord_s), timeline.t_ns},
      [&](Values cells) {
        const auto half_time_s = log::cell_as<std::optional<double>>(cells[2], 2);
        if (log::cell_as<int>(cells[1], 1) != timeline.half || !half_time_s) return;
        timeline.half_time_s = *half_time_s + kicking::seconds(timeline.t_ns - log::cell_as<std::int64_t>(cells[0], 0));
      });
}

void add_tracks(const log::Reader& reader, KickTimeline& timeline) { KickStreams(reader).fill(timeline); }

std::vector<KickTimeline> kick_timelines(const log::Reader& reader) {
  std::vector<KickTimeline> timelines = kicks_without_tracks(reader);
  for (KickTimeline& timeline : timelines) add_tracks(reader, timeline);
  return timelines;
}

}  // namespace trivela::evaluator
