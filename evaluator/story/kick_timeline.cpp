#include "evaluator/story/kick_timeline.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "evaluator/metrics/listed_kicks.sql.hpp"
#include "evaluator/sessions/session_setup.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::evaluator {
namespace {

using kicking::Pose;
using Values = std::span<const log::Value>;

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
  std::vector<KickTimeline> stories;
  reader.query(kListedKicksSql, [&](const log::NamedCells& row) {
    const auto t_ns = row.get<std::int64_t>("t_ns");
    const auto distance_m = row.get<double>("distance_m");
    const auto predicted_x_m = row.find<double>("predicted_x_cross_m");
    const auto predicted_z_m = row.find<double>("predicted_z_cross_m");
    const auto flight_s = row.find<double>("predicted_t_flight_s");
    KickTimeline& story = stories.emplace_back();
    story.session_id = row.get<std::int64_t>("session_id");
    story.robot_id = row.get<int>("robot_id");
    story.kick_id = row.get<std::int64_t>("kick_id");
    story.number = row.get<std::int64_t>("number");
    story.t_ns = t_ns;
    story.utc_ns = row.get<std::int64_t>("utc_ns");
    story.half = row.get<int>("half");
    story.policy = row.get<std::string>("policy");
    story.distance_m = distance_m;
    story.power = row.find<double>("power");
    story.robot = {row.get<double>("x_m"), row.get<double>("y_m"), row.get<double>("heading_rad")};
    story.target_m = {row.get<double>("target_x_m"), row.get<double>("target_y_m")};
    story.bounced = row.find<bool>("bounced");
    story.segments = decided_segments({story.robot, row.get<double>("alpha_rad"), story.target_m, distance_m,
                                       row.get<bool>("aligned"), row.find<double>("offset_right_m"),
                                       row.get<double>("left_m"), row.get<double>("right_m")});
    story.fired_after_s = seconds_after(t_ns, row.find<std::int64_t>("fired_t_ns"));
    story.released_after_s = seconds_after(t_ns, row.find<std::int64_t>("release_t_ns"));
    if (predicted_x_m || predicted_z_m) {
      story.predicted = TimelineEnd{"", predicted_x_m, predicted_z_m, {}, {}};
      if (flight_s) story.predicted->after_s = story.released_after_s.value_or(0.0) + *flight_s;
    }
    story.observed =
        end_of(row.find<std::string>("outcome"), row.find<double>("x_cross_m"), row.find<double>("z_cross_m"),
               row.find<double>("sd_cross_m"), seconds_after(t_ns, row.find<std::int64_t>("settled_t_ns")));
    story.truth = end_of(row.find<std::string>("truth_outcome"), row.find<double>("truth_x_cross_m"),
                         row.find<double>("truth_z_cross_m"));
  });
  return stories;
}

/// Streams of one kick's robot around the kick.
class KickStreams {
 public:
  KickStreams(const log::Reader& reader, const TimelinePlan& plan) : reader_(reader), plan_(plan) {}

  void fill(KickTimeline& story) {
    from_ns_ = story.t_ns - kicking::nanoseconds(plan_.before_s);
    double end_s = plan_.unsettled_s;
    if (story.observed && story.observed->after_s) end_s = *story.observed->after_s + plan_.after_s;
    to_ns_ = story.t_ns + kicking::nanoseconds(std::clamp(end_s, 0.0, plan_.longest_s));
    read_world(story);
    read_flight(story);
    read_opponent(story);
    add_half_time(reader_, story);
  }

 private:
  template <class Row>
  void rows(const KickTimeline& story, const char* table, const std::vector<std::string>& columns, std::int64_t from_ns,
            Row&& row) const {
    reader_.for_each_row_between(table, columns, {story.session_id, story.robot_id, from_ns, to_ns_}, row);
  }

  /// Whether a sample at this instant is the first of its step.
  bool begins_step(std::int64_t t_ns, std::optional<std::int64_t>& last) const {
    const auto step = (t_ns - from_ns_) / kicking::nanoseconds(plan_.step_s);
    return std::exchange(last, step) != step;
  }

  void read_world(KickTimeline& story) {
    world_.clear();
    std::vector<TimelinePlace> ball;
    rows(story, "world_states", {"t_ns", "x_m", "y_m", "heading_rad", "ball_known", "ball_x_m", "ball_y_m"}, from_ns_,
         [&](Values cells) {
           const auto t_ns = log::cell_as<std::int64_t>(cells[0], 0) - story.t_ns;
           world_.push_back({t_ns,
                             {log::cell_as<double>(cells[1], 1), log::cell_as<double>(cells[2], 2),
                              log::cell_as<double>(cells[3], 3)}});
           const auto x_m = log::cell_as<std::optional<double>>(cells[5], 5);
           const auto y_m = log::cell_as<std::optional<double>>(cells[6], 6);
           if (log::cell_as<bool>(cells[4], 4) && x_m && y_m) ball.push_back({t_ns, {*x_m, *y_m, 0.0}});
         });
    cut_at_jumps(story);
    std::optional<std::int64_t> step;
    for (const TimelinePose& at : world_) {
      if (begins_step(story.t_ns + at.t_ns, step)) story.path.push_back(at);
    }
    step.reset();
    for (const TimelinePlace& at : ball) {
      const std::int64_t t_ns = story.t_ns + at.t_ns;
      if (t_ns >= from_ns_ && t_ns <= to_ns_ && begins_step(t_ns, step)) story.ball.push_back(at);
    }
  }

  /// Nobody drives like that: a simulator's next possession, or a robot that was carried. The story is of what lies
  /// between two jumps.
  void cut_at_jumps(const KickTimeline& story) {
    const auto jumps = [](const TimelinePose& a, const TimelinePose& b) {
      const double apart_m = std::hypot(b.pose.x_m - a.pose.x_m, b.pose.y_m - a.pose.y_m);
      return apart_m > std::max(kRobotJump_m, kFastestRobot_mps * kicking::seconds(b.t_ns - a.t_ns));
    };
    const auto decided = std::ranges::upper_bound(world_, std::int64_t{0}, {}, &TimelinePose::t_ns);
    const auto end = std::adjacent_find(decided == world_.begin() ? decided : std::prev(decided), world_.end(), jumps);
    if (end != world_.end()) to_ns_ = story.t_ns + end->t_ns;
    const auto before = std::adjacent_find(std::make_reverse_iterator(decided), world_.rend(),
                                           [&](const TimelinePose& b, const TimelinePose& a) { return jumps(a, b); });
    if (before != world_.rend()) from_ns_ = story.t_ns + before->t_ns;
    std::erase_if(world_, [&](const TimelinePose& at) {
      return story.t_ns + at.t_ns < from_ns_ || story.t_ns + at.t_ns > to_ns_;
    });
  }

  void read_flight(KickTimeline& story) const {
    std::optional<std::int64_t> step;
    rows(story, "flight_frames", {"t_exposure_ns", "ball_seen", "ball_x_m", "ball_y_m", "ball_z_m"}, story.t_ns,
         [&](Values cells) {
           const auto t_ns = log::cell_as<std::int64_t>(cells[0], 0);
           const auto x_m = log::cell_as<std::optional<double>>(cells[2], 2);
           const auto y_m = log::cell_as<std::optional<double>>(cells[3], 3);
           const auto z_m = log::cell_as<std::optional<double>>(cells[4], 4);
           if (log::cell_as<bool>(cells[1], 1) && x_m && y_m && z_m && t_ns >= story.t_ns && begins_step(t_ns, step))
             story.flight.push_back({t_ns - story.t_ns, {*x_m, *y_m, *z_m}});
         });
  }

  /// In R of the pose at the exposure's instant.
  void read_opponent(KickTimeline& story) const {
    if (world_.empty()) return;
    std::optional<std::int64_t> step;
    rows(story, "vision_frames", {"t_exposure_ns", "opponent_seen", "opponent_x_m", "opponent_y_m"}, from_ns_,
         [&](Values cells) {
           const auto t_ns = log::cell_as<std::int64_t>(cells[0], 0);
           const auto x_m = log::cell_as<std::optional<double>>(cells[2], 2);
           const auto y_m = log::cell_as<std::optional<double>>(cells[3], 3);
           if (!log::cell_as<bool>(cells[1], 1) || !x_m || !y_m || t_ns < from_ns_ || !begins_step(t_ns, step)) return;
           const Eigen::Vector2d place = kicking::to_field(nearest_pose(t_ns - story.t_ns), {*x_m, *y_m});
           story.opponent.push_back({t_ns - story.t_ns, {place.x(), place.y(), 0.0}});
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
  TimelinePlan plan_;
  std::int64_t from_ns_ = 0, to_ns_ = 0;
  std::vector<TimelinePose> world_;  // every row of the story's time
};

}  // namespace

std::vector<KickTimeline> kicks_without_tracks(const log::Reader& reader) {
  std::map<std::int64_t, LoggedPitch> pitches;
  for (const log::RecordedSession& session : reader.sessions())
    pitches[session.session_id] = pitch_of(reader.whole(session).config_toml);
  std::vector<KickTimeline> stories = listed_kicks(reader);
  for (KickTimeline& story : stories) {
    story.goal = pitches[story.session_id].goal;
    story.side_line_x_m = pitches[story.session_id].side_line_x_m;
  }
  return stories;
}

void add_half_time(const log::Reader& reader, KickTimeline& story) {
  constexpr double kWord_s = 1.0;  // within which the referee says it again
  reader.for_each_row_between(
      "referee", {"t_ns", "half", "half_time_s"},
      {story.session_id, story.robot_id, story.t_ns - kicking::nanoseconds(kWord_s), story.t_ns}, [&](Values cells) {
        const auto half_time_s = log::cell_as<std::optional<double>>(cells[2], 2);
        if (log::cell_as<int>(cells[1], 1) != story.half || !half_time_s) return;
        story.half_time_s = *half_time_s + kicking::seconds(story.t_ns - log::cell_as<std::int64_t>(cells[0], 0));
      });
}

void add_tracks(const log::Reader& reader, KickTimeline& story, const TimelinePlan& plan) {
  KickStreams(reader, plan).fill(story);
}

std::vector<KickTimeline> kick_timelines(const log::Reader& reader, const TimelinePlan& plan) {
  std::vector<KickTimeline> stories = kicks_without_tracks(reader);
  for (KickTimeline& story : stories) add_tracks(reader, story, plan);
  return stories;
}

}  // namespace trivela::evaluator
