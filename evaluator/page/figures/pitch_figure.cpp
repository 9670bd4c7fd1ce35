#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "evaluator/page/figures/figure.hpp"
#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"

namespace trivela::evaluator::page {
namespace {

constexpr double kBorder_m = 0.6, kGoalDepth_m = 0.5, kAreaDepth_m = 0.75, kPenaltyDepth_m = 2.25;
constexpr double kCircle_m = 2.0, kSquare_m = 0.5;

/// The field from above, +y upwards, from `low_m` to behind the goal.
struct Field {
  Field(const KickTimeline& timeline, double from_m)
      : goal(timeline.goal), side_m(timeline.side_line_x_m), low_m(from_m) {
    const double half_m = side_m + kBorder_m, top_m = goal.y_m + kGoalDepth_m + 0.2;
    const double px_per_m = (kFigureWidth - 8.0) / (2.0 * half_m);
    bottom_px = 4.0 + (top_m - low_m) * px_per_m;
    x = {-half_m, half_m, 4.0, kFigureWidth - 4.0};
    y = {low_m, top_m, bottom_px, 4.0};
  }
  kicking::Goal goal;
  double side_m = 6.0, low_m = 0.0, bottom_px = 0.0;
  Scale x, y;
};

std::string box(const Field& field, double depth_m) {
  const double half_m = field.goal.half_width_m + depth_m;
  const auto p = [&](double x_m, double y_m) { return ChartPoint{field.x.px(x_m), field.y.px(y_m)}; };
  const double line = field.goal.y_m;
  return svg_polyline("field",
                      {p(-half_m, line), p(-half_m, line - depth_m), p(half_m, line - depth_m), p(half_m, line)});
}

/// As much of it as the picture has.
std::string centre_circle(const Field& field) {
  constexpr int kCorners = 120;
  std::vector<ChartPoint> arc;
  for (int i = 0; i <= kCorners; ++i) {  // from below, so that what is cut off lies at its ends
    const double angle_rad = 2.0 * std::numbers::pi * (static_cast<double>(i) / kCorners - 0.25);
    const double y_m = kCircle_m * std::sin(angle_rad);
    if (y_m >= field.low_m) arc.push_back({field.x.px(kCircle_m * std::cos(angle_rad)), field.y.px(y_m)});
  }
  return svg_polyline("field", arc);
}

std::string lines(const Field& field) {
  const auto& [goal, side, low, bottom, x, y] = field;
  const double top = y.px(goal.y_m), floor = std::min(y.px(std::max(low, -goal.y_m)), bottom);
  std::string svg = svg_rect("grass", {x.px(-side), top}, x.px(side) - x.px(-side), floor - top);
  svg += svg_polyline("field", {{x.px(-side), floor}, {x.px(-side), top}, {x.px(side), top}, {x.px(side), floor}});
  svg += box(field, kAreaDepth_m) + box(field, kPenaltyDepth_m);
  if (low < 0.0) {
    svg += svg_line("field", x.px(-side), y.px(0.0), x.px(side), y.px(0.0));
    svg += centre_circle(field);
  }
  const double post = goal.half_width_m;
  return svg + svg_polyline("goal-line", {{x.px(-post), top},
                                          {x.px(-post), y.px(goal.y_m + kGoalDepth_m)},
                                          {x.px(post), y.px(goal.y_m + kGoalDepth_m)},
                                          {x.px(post), top}});
}

std::string held_mark(const Field& field, const HeldChance& chance) {
  const ChartPoint at{field.x.px(chance.x_m), field.y.px(chance.y_m)};
  const std::string words = fmt::format("chance held by {}{}", chance.policy,
                                        chance.shadow_would ? "; another policy would have kicked" : "");
  return titled(words, fmt::format("<path class=\"held{}\" d=\"M{:.1f} {:.1f}l5 9h-10z\"/>",
                                   chance.shadow_would ? " would" : "", at.x, at.y - 5.0));
}

/// Whether a place is on the field, beside its lines included: a robot that lost itself may believe anything.
bool on_field(const KickTimeline& timeline, double x_m, double y_m) {
  return std::abs(x_m) <= timeline.side_line_x_m + kBorder_m && std::abs(y_m) <= timeline.goal.y_m + kGoalDepth_m;
}

/// A kick whose place is known: an imported one has none.
bool has_place(const KickTimeline& timeline) { return timeline.distance_m > 0.0; }

/// What is drawn, and how much of it.
struct DrawnPlaces {
  OutcomeCounts kicks{};  ///< by outcome
  std::size_t held = 0, would = 0, off_field = 0;
  double low_m = 0.0;  ///< y of the lowest

  std::size_t all_kicks() const { return std::accumulate(kicks.begin(), kicks.end(), std::size_t{0}); }
};

DrawnPlaces count_places(const PageData& data, const KickTimeline& any) {
  DrawnPlaces places;
  places.low_m = any.goal.y_m;
  const auto see = [&](double x_m, double y_m) {
    if (on_field(any, x_m, y_m)) {
      places.low_m = std::min(places.low_m, y_m);
    } else {
      ++places.off_field;
    }
  };
  for (const PageKick& kick : data.kicks) {
    if (!has_place(kick.timeline)) continue;
    see(kick.timeline.robot.x_m, kick.timeline.robot.y_m);
    ++places.kicks[static_cast<std::size_t>(kind_of(kick.timeline))];
  }
  for (const HeldChance& chance : data.held_chances) {
    see(chance.x_m, chance.y_m);
    ++places.held;
    places.would += chance.shadow_would ? 1 : 0;
  }
  return places;
}

std::string each_place(const PageData& data, const Field& field, const KickTimeline& any) {
  std::string marks;
  for (const HeldChance& chance : data.held_chances) {
    if (on_field(any, chance.x_m, chance.y_m)) marks += held_mark(field, chance);
  }
  for (std::size_t i = 0; i < data.kicks.size(); ++i) {
    const KickTimeline& timeline = data.kicks[i].timeline;
    const auto& [x_m, y_m, heading_rad] = timeline.robot;
    if (!has_place(timeline) || !on_field(any, x_m, y_m)) continue;
    marks += titled(kick_words(timeline), outcome_mark(kind_of(timeline), {field.x.px(x_m), field.y.px(y_m)}, 4.5),
                    fmt::format(" data-kick=\"{}\"", i));
  }
  return marks;
}

std::string binned_places(const PageData& data, const Field& field, const KickTimeline& any) {
  HeatMap kicked(kSquare_m), held(kSquare_m);
  for (const HeldChance& chance : data.held_chances) {
    if (on_field(any, chance.x_m, chance.y_m)) held.add(chance.x_m, chance.y_m);
  }
  for (const PageKick& kick : data.kicks) {
    const auto& [x_m, y_m, heading_rad] = kick.timeline.robot;
    if (has_place(kick.timeline) && on_field(any, x_m, y_m)) kicked.add(x_m, y_m);
  }
  return held.draw("heat held-heat", field.x, field.y) + kicked.draw("heat", field.x, field.y);
}

std::string legend_of(const DrawnPlaces& places, double y) {
  const double held_y = y + 44.0;
  const auto triangle = [&](const char* kind, double x) {
    return fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}l5 9h-10z\"/>", kind, x, held_y - 9.0);
  };
  return outcome_legend(places.kicks, y) + triangle("held", 14.0) +
         svg_text(26.0, held_y, "start", fmt::format("held: {}", places.held - places.would)) +
         triangle("held would", 186.0) +
         svg_text(198.0, held_y, "start", fmt::format("held, another policy would have kicked: {}", places.would));
}

}  // namespace

std::string pitch_section(const PageView& view) {
  const PageData& data = view.data;
  const KickTimeline any = data.kicks.empty() ? KickTimeline{} : data.kicks.front().timeline;
  const DrawnPlaces places = count_places(data, any);
  if (places.all_kicks() + places.held == 0)
    return paragraphs({"No kick says where it was taken, and no chance was held."});
  const Field field(any, std::min(places.low_m - 0.5, any.goal.y_m - 5.0));
  std::string note = data.binned()
                         ? "Squares of 50 cm: the darker, the more kicks. Grey: chances held."
                         : "Marks: where the robot stood when it decided to kick, as it believed, by what became of "
                           "the kick. Triangles: where it last held in a possession in which it did not kick.";
  if (places.off_field > 0) note += fmt::format(" {} off the field are not drawn.", places.off_field);
  const std::string marks = data.binned() ? binned_places(data, field, any) : each_place(data, field, any);
  const std::string says =
      fmt::format("The field from above with {} kicks and {} chances held", places.all_kicks(), places.held);
  return figure({"pitch-figure", says, field.bottom_px + 82.0, view.simulated},
                lines(field) + marks + legend_of(places, field.bottom_px + 26.0), note);
}

}  // namespace trivela::evaluator::page
