#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evaluator/timeline/decided_segments.hpp"
#include "kicking/geometry/frames.hpp"
#include "kicking/geometry/goal.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// A point of a path, so long after the decision (before it: negative).
struct TimelinePose {
  std::int64_t t_ns = 0;
  kicking::Pose pose{};
};
struct TimelinePlace {
  std::int64_t t_ns = 0;
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();  ///< in F; z is 0 of what is on the floor
};

/// Where and how a kick ended, as predicted, seen or true.
struct TimelineEnd {
  std::string outcome;            ///< empty: of a prediction
  std::optional<double> x_m;      ///< ball centre at the goal line, in F
  std::optional<double> z_m;      ///< its height
  std::optional<double> sd_m;     ///< of both
  std::optional<double> after_s;  ///< after the decision
};

/// A kick with what a replay of it needs. What the log does not have is empty.
struct KickTimeline {
  std::int64_t session_id = 0;
  int robot_id = 0;
  std::int64_t kick_id = 0;
  std::int64_t number = 0;  ///< of the robot's orders in its own session, from 1
  std::int64_t t_ns = 0;    ///< of the decision, by the session's clock
  std::int64_t utc_ns = 0;  ///< the same instant
  int half = 0;
  std::optional<double> half_time_s;  ///< since the half's first start of play, by the referee
  std::string policy;
  double distance_m = 0.0;
  std::optional<double> power;
  kicking::Pose robot{};                               ///< at the decision
  Eigen::Vector2d target_m = Eigen::Vector2d::Zero();  ///< aim point
  std::optional<bool> bounced;                         ///< it touched the floor before the line, as observed
  std::optional<bool> saved;  ///< on target, and a keeper stopped it: as observed or said by hand
  int kick_kind = 0;          ///< of the robot's kinds of kick, in the order of its file
  kicking::Goal goal{};
  double side_line_x_m = 6.0;
  std::vector<TimelinePose> path;       ///< of the robot
  std::vector<TimelinePlace> ball;      ///< as the robot believed
  std::vector<TimelinePlace> flight;    ///< as its flight camera saw the ball
  std::vector<TimelinePlace> opponent;  ///< the nearest one that it saw
  std::vector<Eigen::Vector2d> others;  ///< opponents that it tracked at the decision, in F
  std::optional<double> keeper_x_m;     ///< the keeper along its goal line, at the decision
  DecidedSegments segments;
  std::optional<double> fired_after_s;     ///< the coil was energised, after the decision
  std::optional<double> released_after_s;  ///< the ball was expected to leave
  std::optional<TimelineEnd> predicted;
  std::optional<TimelineEnd> observed;
  std::optional<TimelineEnd> truth;  ///< of the simulator
};

/// The log's kicks that count, with their pitch and without their tracks, as kick_timelines() orders them. Throws
/// std::runtime_error where the log cannot be read.
std::vector<KickTimeline> kicks_without_tracks(const log::Reader& reader);

/// Adds the time of the half, by the referee's last word before the decision. Throws std::runtime_error where the log
/// cannot be read.
void add_half_time(const log::Reader& reader, KickTimeline& timeline);

/// Adds the tracks, and the time of the half. Throws std::runtime_error where the log cannot be read.
void add_tracks(const log::Reader& reader, KickTimeline& timeline);

/// The timelines of the log's kicks that count, in the order of their time; refused orders are none. Throws
/// std::runtime_error where the log cannot be read.
std::vector<KickTimeline> kick_timelines(const log::Reader& reader);

/// For replay() of evaluator/timeline/replay.js: whole centimetres, milliseconds after the decision and
/// milliradians; kick_id and session_id as texts, since JavaScript's numbers do not hold them; nothing for what is
/// empty. `json.dump()` is the same text for the same log.
nlohmann::ordered_json json_of(const KickTimeline& timeline);

/// `replay(container, timeline)` in plain JavaScript, without a library or a request: draws the timeline of a kick from
/// above and from the side and plays it. To be put into a page as a script with replay_style() beside it. It sets no
/// inline style and reads no text as HTML: a strict content-security policy lets it work, and texts of a log stay
/// texts.
std::string_view replay_script();

/// Its style sheet: colours for light and dark readers as variables of .replay.
std::string_view replay_style();

}  // namespace trivela::evaluator
