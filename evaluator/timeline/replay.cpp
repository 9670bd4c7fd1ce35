#include "evaluator/timeline/kick_timeline.hpp"

#include <fmt/format.h>

#include <cmath>

#include "evaluator/render/json_values.hpp"
#include "evaluator/timeline/replay.css.hpp"
#include "evaluator/timeline/replay.js.hpp"

namespace trivela::evaluator {
namespace {

std::int64_t whole(double value) { return std::isfinite(value) ? std::llround(value) : 0; }
std::int64_t cm(double metres) { return whole(100.0 * metres); }
std::int64_t ms(std::int64_t time_ns) { return whole(1e-6 * static_cast<double>(time_ns)); }

void put(Json& json, const char* key, const std::optional<double>& value, double factor) {
  if (value) json[key] = whole(factor * *value);
}

Json pair_of(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  return Json::array({cm(from_m.x()), cm(from_m.y()), cm(to_m.x()), cm(to_m.y())});
}

void put_path(Json& json, const std::vector<TimelinePose>& path) {
  if (path.empty()) return;
  Json t = Json::array(), x = Json::array(), y = Json::array(), heading = Json::array();
  for (const TimelinePose& at : path) {
    t.push_back(ms(at.t_ns));
    x.push_back(cm(at.pose.x_m));
    y.push_back(cm(at.pose.y_m));
    heading.push_back(whole(1000.0 * at.pose.heading_rad));
  }
  json["path"] = {{"t_ms", t}, {"x_cm", x}, {"y_cm", y}, {"heading_mrad", heading}};
}

void put_places(Json& json, const char* key, const std::vector<TimelinePlace>& places, bool with_height) {
  if (places.empty()) return;
  Json t = Json::array(), x = Json::array(), y = Json::array(), z = Json::array();
  for (const TimelinePlace& at : places) {
    t.push_back(ms(at.t_ns));
    x.push_back(cm(at.place_m.x()));
    y.push_back(cm(at.place_m.y()));
    if (with_height) z.push_back(cm(at.place_m.z()));
  }
  json[key] = {{"t_ms", t}, {"x_cm", x}, {"y_cm", y}};
  if (with_height) json[key]["z_cm"] = z;
}

void put_end(Json& json, const char* key, const std::optional<TimelineEnd>& end) {
  if (!end) return;
  Json& at = json[key] = Json::object();
  if (!end->outcome.empty()) at["outcome"] = end->outcome;
  put(at, "x_cm", end->x_m, 100.0);
  put(at, "z_cm", end->z_m, 100.0);
  put(at, "sd_cm", end->sd_m, 100.0);
  put(at, "t_ms", end->after_s, 1000.0);
}

}  // namespace

Json json_of(const KickTimeline& timeline) {
  Json json{{"kick", fmt::format("{}:{}", timeline.robot_id, timeline.number)},
            {"kick_id", fmt::format("{}", timeline.kick_id)},
            {"session_id", fmt::format("{}", timeline.session_id)},
            {"robot", timeline.robot_id},
            {"policy", timeline.policy},
            {"half", timeline.half},
            {"utc_ms", ms(timeline.utc_ns)}};
  if (timeline.kick_kind != 0) json["kick_kind"] = timeline.kick_kind;
  put(json, "half_time_ms", timeline.half_time_s, 1000.0);
  json["distance_cm"] = cm(timeline.distance_m);
  if (timeline.power) json["power"] = static_cast<double>(whole(100.0 * *timeline.power)) / 100.0;
  json["pitch"] = {{"goal_y_cm", cm(timeline.goal.y_m)},
                   {"goal_half_width_cm", cm(timeline.goal.half_width_m)},
                   {"goal_height_cm", cm(timeline.goal.height_m)},
                   {"post_cm", cm(timeline.goal.post_width_m)},
                   {"side_line_x_cm", cm(timeline.side_line_x_m)}};
  const DecidedSegments& segments = timeline.segments;
  json["segments"] = {{"s1_cm", pair_of(segments.s1_from_m, segments.s1_to_m)},
                      {"s2_cm", pair_of(segments.s2_left_m, segments.s2_right_m)},
                      {"aligned", segments.aligned}};
  put(json, "fired_ms", timeline.fired_after_s, 1000.0);
  put(json, "released_ms", timeline.released_after_s, 1000.0);
  put_end(json, "predicted", timeline.predicted);
  put_end(json, "observed", timeline.observed);
  if (timeline.observed && timeline.saved) json["observed"]["saved"] = *timeline.saved;
  put_end(json, "truth", timeline.truth);
  put_path(json, timeline.path);
  put_places(json, "ball", timeline.ball, false);
  put_places(json, "flight", timeline.flight, true);
  put_places(json, "opponent", timeline.opponent, false);
  for (const Eigen::Vector2d& at : timeline.others) json["others_cm"].push_back({cm(at.x()), cm(at.y())});
  put(json, "keeper_x_cm", timeline.keeper_x_m, 100.0);
  return json;
}

std::string_view replay_script() { return kReplayJs; }

std::string_view replay_style() { return kReplayCss; }

}  // namespace trivela::evaluator
