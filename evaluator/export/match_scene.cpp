#include "evaluator/export/match_scene.hpp"

#include <numbers>
#include <optional>

#include "evaluator/timeline/decided_segments.hpp"
#include "kicking/constants.hpp"
#include "log/schema/queries.hpp"

namespace trivela::evaluator {
namespace {

using mcap::Colour;
using mcap::Header;
using mcap::Marker;

constexpr std::string_view kMarkers = "visualization_msgs/MarkerArray";
constexpr Colour kWhite{1, 1, 1, 1}, kOrange{1, 0.5F, 0, 1}, kBlue{0.2F, 0.5F, 1, 1}, kGreen{0.2F, 0.8F, 0.3F, 1},
    kGrey{0.6F, 0.6F, 0.6F, 0.8F};

/// Cells of a row by the names of their columns.
struct Cells {
  const Places& at;
  std::span<const log::Value> row;

  double number(std::string_view column) const { return log::cell_as<double>(row[at[column]], at[column]); }
  bool truth(std::string_view column) const { return log::cell_as<bool>(row[at[column]], at[column]); }
  std::optional<double> optional(std::string_view column) const {
    return log::cell_as<std::optional<double>>(row[at[column]], at[column]);
  }
};

Header in_field(std::int64_t t_ns) { return {t_ns, "field"}; }

Marker ball_at(const std::string& what, const Colour& colour, const std::optional<Eigen::Vector3d>& place) {
  Marker marker{what, Marker::kSphere, place.has_value(), colour, 2.0 * kicking::Ball{}.radius_m, {}};
  if (place) marker.places = {*place};
  return marker;
}

/// A crossing of the goal line; none where it is not known.
Marker crossing(const std::string& what, const Colour& colour, std::optional<double> x_m, double y_m,
                std::optional<double> z_m) {
  std::optional<Eigen::Vector3d> place;
  if (x_m && z_m) place.emplace(*x_m, y_m, *z_m);
  return ball_at(what, colour, place);
}

std::vector<Marker> segments(const Cells& cells) {
  const DecidedSegments s = decided_segments({{cells.number("x_m"), cells.number("y_m"), cells.number("heading_rad")},
                                              cells.number("alpha_rad"),
                                              {cells.number("target_x_m"), cells.number("target_y_m")},
                                              cells.number("distance_m"),
                                              cells.truth("aligned"),
                                              cells.optional("offset_right_m"),
                                              cells.number("left_m"),
                                              cells.number("right_m")});
  const auto up = [](const Eigen::Vector2d& p) { return Eigen::Vector3d(p.x(), p.y(), 0.02); };
  const Colour& s1 = s.aligned ? kGreen : kOrange;
  return {Marker{"s1", Marker::kLineList, true, s1, 0.03, {up(s.s1_from_m), up(s.s1_to_m)}},
          Marker{"s2", Marker::kLineList, true, kBlue, 0.03, {up(s.s2_left_m), up(s.s2_right_m)}}};
}

}  // namespace

Places::Places(const log::StreamTable& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) places_[table.columns[i].name] = i;
}

std::size_t Places::operator[](std::string_view column) const { return places_.find(column)->second; }

void MatchScene::put_field(const LoggedPitch& pitch, std::int64_t t_ns, const std::string& topic,
                           const PutMessage& put) {
  const double side = pitch.side_line_x_m, line = pitch.goal.y_m;
  const double post = pitch.goal.half_width_m + 0.5 * pitch.goal.post_width_m;
  const double bar = pitch.goal.height_m + 0.5 * pitch.goal.post_width_m;
  Marker lines{"lines", Marker::kLineList, true, kWhite, 0.125, {}};
  for (const double y : {-line, 0.0, line}) lines.places.insert(lines.places.end(), {{-side, y, 0.0}, {side, y, 0.0}});
  for (const double x : {-side, side}) lines.places.insert(lines.places.end(), {{x, -line, 0.0}, {x, line, 0.0}});
  Marker goals{"goals", Marker::kLineList, true, kWhite, pitch.goal.post_width_m, {}};
  for (const double y : {-line, line}) {
    goals.places.insert(goals.places.end(), {{-post, y, 0.0}, {-post, y, bar}, {post, y, 0.0}, {post, y, bar}});
    goals.places.insert(goals.places.end(), {{-post, y, bar}, {post, y, bar}});
  }
  write_markers(cdr_, in_field(t_ns), {lines, goals});
  put(topic, kMarkers);
}

void MatchScene::put_row(const log::StreamTable& table, const Places& at, std::span<const log::Value> row,
                         std::int64_t t_ns, double goal_y_m, const std::string& prefix, const std::string& robot,
                         const PutMessage& put) {
  const Cells cells{at, row};
  const Header header = in_field(t_ns);
  const auto crossings = [&](const Marker& marker) {
    write_markers(cdr_, header, {marker});
    put(prefix + "/crossings", kMarkers);
  };
  if (table.name == "world_states") {
    const mcap::FloorPose pose{cells.number("x_m"), cells.number("y_m"),
                               cells.number("heading_rad") + 0.5 * std::numbers::pi};
    write_transform(cdr_, header, robot, pose);
    put("/tf", "tf2_msgs/TFMessage");
    write_pose(cdr_, header, pose);
    put(prefix + "/pose", "geometry_msgs/PoseStamped");
    const auto x_m = cells.optional("ball_x_m"), y_m = cells.optional("ball_y_m");
    std::optional<Eigen::Vector3d> ball;
    if (cells.truth("ball_known") && x_m && y_m) ball.emplace(*x_m, *y_m, kicking::Ball{}.radius_m);
    write_markers(cdr_, header, {ball_at("ball", kOrange, ball)});
    put(prefix + "/ball", kMarkers);
  } else if (table.name == "kick_decisions") {
    write_markers(cdr_, header, segments(cells));
    put(prefix + "/alignment", kMarkers);
    if (cells.truth("fire"))
      crossings(crossing("predicted", kBlue, cells.optional("predicted_x_cross_m"), cells.number("target_y_m"),
                         cells.optional("predicted_z_cross_m")));
  } else if (table.name == "kick_outcomes") {
    crossings(crossing("observed", kGreen, cells.optional("x_cross_m"), goal_y_m, cells.optional("z_cross_m")));
  } else if (table.name == "kick_truths") {
    crossings(crossing("simulated truth", kGrey, cells.optional("x_cross_m"), goal_y_m, cells.optional("z_cross_m")));
  }
}

}  // namespace trivela::evaluator
