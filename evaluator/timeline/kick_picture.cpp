#include "evaluator/timeline/kick_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "evaluator/render/svg_chart.hpp"
#include "kicking/ballistics/crossing.hpp"
#include "kicking/outcome/outcome.hpp"

namespace trivela::evaluator {
namespace {

using Point = Eigen::Vector2d;

constexpr double kWidth = 1000.0, kHeight = 576.0, kColumn = 652.0, kColumnWidth = 328.0, kRow = 22.0;
constexpr double kFieldLeft = 16.0, kFieldTop = 62.0, kFieldWidth = 610.0, kFieldHeight = 502.0;
constexpr double kFloor = 528.0, kSideHeight = 170.0;  // of the view from the side
constexpr double kArrow_s = 0.3;                       // an arrow is as long as the way in this time
// CAMBADA release 1.0, cambada.conf.xml: how far goal area and penalty area reach from the posts and from the goal
// line, the penalty mark, the centre circle, the goal's depth, the robot's radius.
constexpr double kGoalArea_m = 0.75, kPenaltyArea_m = 2.25, kPenaltyMark_m = 3.0, kCentreCircle_m = 2.0;
constexpr double kGoalDepth_m = 0.5, kRobotRadius_m = 0.24;
constexpr const char* kStyle =
    "polyline.field{stroke:#888;stroke-width:1.3}\npolyline.arrow{stroke-width:3.2}\npolyline.wide{stroke-width:5}\n"
    "circle.outline,circle.ball{fill:none;stroke:#888;stroke-width:1.8}\ncircle.robot{fill-opacity:0.3}\n"
    "rect.frame{fill:#888}\nrect.grass{fill:#0a0;fill-opacity:0.07}\n";

/// What follows from the picture's kick.
struct Flight {
  kicking::PredictedCrossing crossing;
  kicking::Pose release;
  Point kick_mps, own_mps;  ///< over the floor, in F
  double alpha_rad = 0.0;
  double v_z_mps = 0.0;
  double t_floor_s = 0.0;  ///< first touch
  kicking::Alignment alignment;

  Point end_m;  ///< of the crossing

  Point at(double t_s) const { return crossing.release_m + t_s * (kick_mps + own_mps); }
  bool bounces() const { return t_floor_s < crossing.t_flight_s; }
};

Flight fly(const KickPicture& picture) {
  const auto& [robot, twist, kick, goal, side, ball, gravity, segments] = picture;
  const auto crossing = kicking::predict_crossing(robot, twist, kick, goal.y_m, ball.radius_m, gravity);
  if (!crossing) throw std::invalid_argument("the kick cannot be drawn: the ball does not fly towards the goal line");
  Flight flight;
  flight.crossing = *crossing;
  flight.release = kicking::advance(robot, twist, kick.delay_s);
  const double heading_rad = flight.release.heading_rad;
  flight.kick_mps = kick.v_kick_mps * kick.exit_angle.cosine * kicking::direction(heading_rad);
  flight.own_mps = kicking::rotate({kick.transfer.lateral * (twist.vx_mps - twist.omega_radps * kick.ball_offset_m),
                                    kick.transfer.along_mps(twist.vy_mps)},
                                   heading_rad);
  flight.alpha_rad =
      kicking::alpha_physical_rad(kick.v_kick_mps, kick.exit_angle, kick.transfer, twist, kick.ball_offset_m);
  flight.v_z_mps = kick.v_kick_mps * kick.exit_angle.sine;
  flight.t_floor_s = 2.0 * flight.v_z_mps / gravity;
  flight.end_m = {crossing->x_m, goal.y_m};
  flight.alignment = kicking::align(flight.release, flight.alpha_rad, 0.0, 0.0, {0.0, goal.y_m}, segments);
  return flight;
}

std::string arrow(const std::string& colour, const ChartPoint& from, const ChartPoint& to) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (length < 1.0) return "";
  const double x = (to.x - from.x) / length, y = (to.y - from.y) / length, head = std::min(10.0, 0.6 * length);
  const auto wing = [&](double aside) {
    return ChartPoint{to.x - head * (x + aside * y), to.y - head * (y - aside * x)};
  };
  return svg_polyline(colour + " arrow", {from, to}) + svg_polyline(colour + " arrow", {wing(0.5), to, wing(-0.5)});
}

/// The view from above. Metres in F become pixels.
class Above {
 public:
  Above(const KickPicture& picture, const Flight& flight)
      : picture_(picture), flight_(flight), outwards_(picture.goal.y_m < 0.0 ? -1.0 : 1.0) {
    const double goal = picture.goal.y_m;
    Point low(-picture.side_line_x_m, std::min(0.0, goal)), high(picture.side_line_x_m, std::max(0.0, goal));
    const Point ball = flight.crossing.release_m;
    for (const Point& seen : {Point(0.0, goal + outwards_ * (kGoalDepth_m + 0.4)), flight.end_m, ball,
                              Point(flight.release.x_m, flight.release.y_m), Point(ball + kArrow_s * flight.kick_mps),
                              Point(ball + kArrow_s * flight.own_mps)}) {
      low = low.cwiseMin(seen);
      high = high.cwiseMax(seen);
    }
    const Point size = high - low;
    scale = std::min(kFieldWidth / size.x(), kFieldHeight / size.y());
    middle_ = 0.5 * (low + high);
  }

  std::string draw() const { return field() + robot() + segments() + way() + arrows() + crossing(); }

  double scale = 1.0;  ///< pixels a metre

 private:
  ChartPoint px(const Point& place_m) const {
    return {kFieldLeft + 0.5 * kFieldWidth + scale * (place_m.x() - middle_.x()),
            kFieldTop + 0.5 * kFieldHeight - scale * (place_m.y() - middle_.y())};
  }
  std::string line(const char* kind, const std::vector<Point>& places_m) const {
    std::vector<ChartPoint> points;
    points.reserve(places_m.size());
    for (const Point& place : places_m) points.push_back(px(place));
    return svg_polyline(kind, points);
  }

  /// A box on the goal line, `depth_m` into the field.
  std::string box(const char* kind, double half_width_m, double depth_m) const {
    const double y = picture_.goal.y_m, end = y - outwards_ * depth_m;
    return line(kind, {{-half_width_m, y}, {-half_width_m, end}, {half_width_m, end}, {half_width_m, y}});
  }

  std::string field() const {
    const kicking::Goal& goal = picture_.goal;
    const double x = picture_.side_line_x_m, y = goal.y_m, w = goal.half_width_m;
    std::vector<Point> circle;
    for (double angle = -90.0; angle <= 90.0; angle += 5.0)
      circle.push_back(outwards_ * kCentreCircle_m * kicking::direction(kicking::radians(angle)));
    const ChartPoint corner = px({-x, std::max(0.0, y)});
    std::string svg = svg_rect("grass", corner, 2.0 * x * scale, std::abs(y) * scale) +
                      svg_text(corner.x + 8.0, corner.y + std::abs(y) * scale - 8.0, "start",
                               fmt::format("one half of {:g} x {:g} m", 2.0 * std::abs(y), 2.0 * x)) +
                      line("field", {{-x, 0.0}, {-x, y}, {x, y}, {x, 0.0}, {-x, 0.0}}) + line("field", circle) +
                      box("field", w + kGoalArea_m, kGoalArea_m) + box("field", w + kPenaltyArea_m, kPenaltyArea_m) +
                      box("axis goal", w, -kGoalDepth_m) +
                      svg_circle("outline", px({0.0, y - outwards_ * kPenaltyMark_m}), 1.0);
    const double post = goal.post_width_m * scale;
    for (const double left : {-w - goal.post_width_m, w}) {
      const ChartPoint at = px({left, y});
      svg += svg_rect("frame", {at.x, at.y - 0.5 * post}, post, post);
    }
    return svg;
  }

  std::string robot() const {
    const kicking::Pose& now = flight_.release;
    const Point centre(now.x_m, now.y_m);
    return svg_circle("outline", px({picture_.robot.x_m, picture_.robot.y_m}), kRobotRadius_m * scale) +
           svg_circle("robot c6", px(centre), kRobotRadius_m * scale) +
           line("c6", {centre, centre + kRobotRadius_m * kicking::direction(now.heading_rad)}) +
           svg_circle("ball", px(flight_.crossing.release_m), picture_.ball.radius_m * scale);
  }

  std::string segments() const {
    const kicking::Alignment& alignment = flight_.alignment;
    const Point centre(flight_.release.x_m, flight_.release.y_m), target(0.0, picture_.goal.y_m);
    const Point along = kicking::direction(flight_.release.heading_rad - flight_.alpha_rad);
    const Point t = (target - centre).normalized(), right(t.y(), -t.x());
    const double length =
        std::min((alignment.centre_distance_m + 0.3) / std::max(along.dot(t), 0.1), picture_.segments.reach_m);
    return line("c3 d1", {centre, centre + length * along}) +
           line("c4 wide", {target - alignment.left_m * right, target + alignment.right_m * right});
  }

  std::string way() const {
    const Point ball = flight_.crossing.release_m;
    if (!flight_.bounces()) return line("c6", {ball, flight_.end_m});
    const Point touch = flight_.at(flight_.t_floor_s);
    return line("c6", {ball, touch}) + line("c6 d2", {touch, flight_.end_m}) + svg_circle("touch c6", px(touch), 4.0);
  }

  std::string arrows() const {
    const Point ball = flight_.crossing.release_m, sum = flight_.kick_mps + flight_.own_mps;
    const Point left = Point(-sum.y(), sum.x()).normalized();
    // Where both go one way, they stand beside their sum.
    const bool one_way = std::abs(left.dot(flight_.own_mps)) < 0.1 * flight_.own_mps.norm();
    const Point foot = ball + (one_way ? 7.0 / scale : 0.0) * left, kicked = foot + kArrow_s * flight_.kick_mps;
    return arrow("c0", px(foot), px(kicked)) + arrow("c1", px(kicked), px(kicked + kArrow_s * flight_.own_mps)) +
           arrow("c2", px(ball), px(ball + kArrow_s * sum));
  }

  std::string crossing() const {
    const ChartPoint mark = px(flight_.end_m);
    const double x = std::clamp(mark.x, kFieldLeft + 90.0, kFieldLeft + kFieldWidth - 90.0);
    const double y = px({0.0, picture_.goal.y_m + outwards_ * (kGoalDepth_m + 0.1)}).y;
    const std::string height = flight_.bounces() ? "on the floor" : fmt::format("z = {:.2f} m", flight_.crossing.z_m);
    return svg_circle("crossing c1", mark, 5.0) +
           svg_text(x, y + (outwards_ > 0.0 ? 0.0 : 14.0), "middle",
                    fmt::format("x = {:.2f} m, {}", flight_.crossing.x_m, height));
  }

  const KickPicture& picture_;
  const Flight& flight_;
  double outwards_;
  Point middle_;
};

/// The view from the side, along the ball's way; as large as the one from above where it has the room.
std::string from_the_side(const KickPicture& picture, const Flight& flight, double largest_scale) {
  const kicking::Goal& goal = picture.goal;
  const double radius = picture.ball.radius_m, t_end = std::min(flight.t_floor_s, flight.crossing.t_flight_s);
  const double v_h = (flight.kick_mps + flight.own_mps).norm(), length_m = v_h * flight.crossing.t_flight_s;
  const double t_apex = std::min(t_end, flight.v_z_mps / picture.gravity_mps2);
  const auto height = [&](double t) { return radius + t * (flight.v_z_mps - 0.5 * picture.gravity_mps2 * t); };
  const double top_m = std::max(height(t_apex), goal.height_m + goal.post_width_m);
  const double scale = std::min({largest_scale, (kColumnWidth - 30.0) / (length_m + 1e-9), kSideHeight / top_m});
  const auto px = [&](double way_m, double z_m) {
    return ChartPoint{kColumn + 12.0 + scale * way_m, kFloor - scale * z_m};
  };

  std::string svg =
      svg_text(kColumn, kFloor - scale * top_m - 36.0, "start", "From the side, along the ball's way [m]") +
      svg_line("axis", kColumn, kFloor, kColumn + kColumnWidth, kFloor);
  for (const double tick : round_ticks(0.0, length_m + 0.01)) {
    if (tick > length_m) break;
    svg += svg_text(px(tick, 0.0).x, kFloor + 18.0, "middle", fmt::format("{:g}", tick));
  }
  const ChartPoint bar = px(length_m, goal.height_m + goal.post_width_m),
                   end = px(length_m, std::max(radius, flight.crossing.z_m));
  svg += svg_line("axis", end.x, kFloor, end.x, bar.y);
  svg += svg_rect("frame", {bar.x - 0.5 * scale * goal.post_width_m, bar.y}, scale * goal.post_width_m,
                  scale * goal.post_width_m);
  std::vector<ChartPoint> way;
  for (int i = 0; i <= 40; ++i) way.push_back(px(v_h * t_end * i / 40.0, height(t_end * i / 40.0)));
  svg += svg_polyline("c6", way);
  if (flight.bounces()) svg += svg_polyline("c6 d2", {way.back(), end});
  const ChartPoint apex = px(v_h * t_apex, height(t_apex));
  svg += svg_text(apex.x, apex.y - 8.0, "middle", fmt::format("{:.2f} m", height(t_apex)));
  return svg + svg_circle("ball", px(0.0, radius), radius * scale) + svg_circle("ball", end, radius * scale) +
         svg_circle("crossing c1", end, 3.0);
}

std::string legend(const KickPicture& picture, const Flight& flight) {
  double y = kFieldTop + 14.0;
  std::string svg;
  const auto entry = [&](const std::string& sample, const std::string& words) {
    svg += sample + svg_text(kColumn + 44.0, y + 5.0, "start", words);
    y += kRow;
  };
  const auto sample = [&](const char* kind) { return svg_polyline(kind, {{kColumn, y}, {kColumn + 34.0, y}}); };
  const auto sample_arrow = [&](const char* colour) { return arrow(colour, {kColumn, y}, {kColumn + 34.0, y}); };
  const double deflection_deg = kicking::degrees(flight.alpha_rad);
  entry(sample_arrow("c0"), fmt::format("kicker: {:.2f} m/s over the floor", flight.kick_mps.norm()));
  entry(sample_arrow("c1"), fmt::format("the robot's own motion: {:.2f} m/s", flight.own_mps.norm()));
  entry(sample_arrow("c2"),
        fmt::format("their sum: {:.2f} m/s, {}", (flight.kick_mps + flight.own_mps).norm(),
                    std::abs(deflection_deg) < 0.05 ? "straight ahead"
                                                    : fmt::format("{:.1f} degrees {}", std::abs(deflection_deg),
                                                                  deflection_deg < 0.0 ? "left" : "right")));
  entry(sample("c6"), fmt::format("the ball's way, {:.2f} s", flight.crossing.t_flight_s));
  if (flight.bounces()) entry(sample("c6 d2"), "after it touched the floor");
  entry(sample("c3 d1"), "segment 1: from the robot along the kick");
  entry(sample("c4 wide"), fmt::format("segment 2: the target, {:g} m to each side", picture.segments.half_width_m));
  entry(svg_circle("crossing c1", {kColumn + 17.0, y}, 5.0), "where the ball crosses the goal line");
  if (picture.kick.delay_s > 0.0)
    entry(svg_circle("outline", {kColumn + 17.0, y}, 8.0),
          fmt::format("the robot at the order, {:g} s before", picture.kick.delay_s));
  y += 0.5 * kRow;
  const bool aligned = flight.alignment.aligned;
  entry("", aligned ? "The segments meet: aligned." : "The segments do not meet: not aligned.");
  return svg;
}

}  // namespace

std::string to_svg(const KickPicture& picture) {
  const Flight flight = fly(picture);
  const Above above(picture, flight);
  const char* const title = "One kick of a moving robot";
  return svg_head(kWidth, kHeight, title, kStyle) + svg_text(0.5 * kWidth, 26.0, "middle", title, " class=\"title\"") +
         svg_text(0.5 * kWidth, 46.0, "middle",
                  fmt::format("computed without drag, to scale; an arrow is the way of {:g} s", kArrow_s)) +
         above.draw() + legend(picture, flight) + from_the_side(picture, flight, above.scale) + "</svg>\n";
}

}  // namespace trivela::evaluator
