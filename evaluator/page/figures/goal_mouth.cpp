#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluator/page/figures/figure.hpp"
#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"

namespace trivela::evaluator::page {
namespace {

constexpr double kBeside_m = 1.0, kAbove_m = 0.9;  // shown around the goal
constexpr double kCell_m = 0.1;

/// The goal's view from in front of it: metres to pixels.
struct Mouth {
  explicit Mouth(const kicking::Goal& shown) : goal(shown) {
    const double half_m = goal.half_width_m + goal.post_width_m + kBeside_m;
    const double top_m = goal.height_m + goal.post_width_m + kAbove_m;
    const double px_per_m = (kFigureWidth - 8.0) / (2.0 * half_m);
    floor_px = 6.0 + top_m * px_per_m;
    x = {-half_m, half_m, 4.0, kFigureWidth - 4.0};
    z = {0.0, top_m, floor_px, 6.0};
  }
  bool shows(double x_m, double z_m) const { return std::abs(x_m) <= x.to && z_m <= z.to && z_m >= 0.0; }

  kicking::Goal goal;
  double floor_px = 0.0;
  Scale x, z;
};

std::string frame(const Mouth& mouth) {
  const auto& goal = mouth.goal;
  const double post = mouth.x.length_px(goal.post_width_m), top = mouth.z.px(goal.height_m + goal.post_width_m);
  const double left = mouth.x.px(-goal.half_width_m - goal.post_width_m), right = mouth.x.px(goal.half_width_m);
  const double height = mouth.floor_px - top;
  return svg_rect("net", {left + post, top + post}, right - left - post, height - post) +
         svg_rect("goal-frame", {left, top}, post, height) + svg_rect("goal-frame", {right, top}, post, height) +
         svg_rect("goal-frame", {left, top}, right - left + post, post) +
         svg_line("axis", mouth.x.from_px, mouth.floor_px, mouth.x.to_px, mouth.floor_px);
}

std::string metres(const Mouth& mouth) {
  std::string svg;
  for (int x_m = -static_cast<int>(mouth.x.to); x_m <= static_cast<int>(mouth.x.to); ++x_m) {
    svg += svg_line("axis", mouth.x.px(x_m), mouth.floor_px, mouth.x.px(x_m), mouth.floor_px + 5.0);
    svg += svg_text(mouth.x.px(x_m), mouth.floor_px + 19.0, "middle", fmt::format("{}", x_m));
  }
  return svg + svg_text(0.5 * kFigureWidth, mouth.floor_px + 37.0, "middle", "to the right of the goal's middle [m]");
}

std::string crossing(const Mouth& mouth, std::size_t number, const KickTimeline& timeline) {
  const TimelineEnd& end = *timeline.observed;
  const ChartPoint at{mouth.x.px(std::clamp(*end.x_m, -mouth.x.to, mouth.x.to)),
                      mouth.z.px(std::clamp(*end.z_m, 0.0, mouth.z.to))};
  const OutcomeKind kind = kind_of(timeline);
  std::string marks;
  if (end.sd_m && *end.sd_m > 0.0 && mouth.shows(*end.x_m, *end.z_m)) {
    marks += svg_circle(std::string("spread ") + kOutcomeNames[static_cast<std::size_t>(kind)].key, at,
                        mouth.x.length_px(std::min(*end.sd_m, 2.0)));
  }
  marks += outcome_mark(kind, at, 4.5);
  const std::string spread = end.sd_m ? fmt::format(" \u00b1 {:.2f}", *end.sd_m) : "";
  return titled(
      fmt::format("{}; crossed at {:+.2f} m, {:.2f} m high{}", kick_words(timeline), *end.x_m, *end.z_m, spread), marks,
      fmt::format(" data-kick=\"{}\"", number));
}

}  // namespace

std::string goal_mouth_section(const PageView& view) {
  const auto& kicks = view.data.kicks;
  OutcomeCounts counts{};
  std::size_t drawn = 0, at_edge = 0, other_goals = 0;
  if (kicks.empty()) return paragraphs({"There are no kicks."});
  const Mouth mouth(kicks.front().timeline.goal);
  HeatMap cells(kCell_m);
  std::string marks;
  for (std::size_t i = 0; i < kicks.size(); ++i) {
    const KickTimeline& timeline = kicks[i].timeline;
    if (!timeline.observed || !timeline.observed->x_m || !timeline.observed->z_m) continue;
    const double x_m = *timeline.observed->x_m, z_m = *timeline.observed->z_m;
    ++counts[static_cast<std::size_t>(kind_of(timeline))];
    ++drawn;
    at_edge += mouth.shows(x_m, z_m) ? 0 : 1;
    other_goals += timeline.goal.half_width_m != mouth.goal.half_width_m ? 1 : 0;
    if (view.data.binned()) {
      cells.add(std::clamp(x_m, -mouth.x.to, mouth.x.to - 1e-6), std::clamp(z_m, 0.0, mouth.z.to - 1e-6));
    } else {
      marks += crossing(mouth, i, timeline);
    }
  }
  if (drawn == 0) return paragraphs({"No kick has an observed crossing of the goal line."});
  if (view.data.binned()) marks = cells.draw("heat", mouth.x, mouth.z);
  const std::string says = fmt::format("The goal from in front with {} observed crossings", drawn);
  std::string note = fmt::format(
      "Where the ball's centre crossed the goal line as the robots saw it, from in front of the goal. {}",
      view.data.binned()
          ? fmt::format("Squares of 10 cm: the darker, the more kicks; the fullest has {}.", cells.fullest())
          : "The pale disc around a mark is one standard deviation of the observation.");
  if (at_edge > 0) note += fmt::format(" {} beyond the picture lie at its edge.", at_edge);
  if (other_goals > 0) note += fmt::format(" {} were at a goal of another width.", other_goals);
  if (drawn < kicks.size())
    note += fmt::format(" {} of {} kicks have no crossing that was seen.", kicks.size() - drawn, kicks.size());
  return figure({"mouth-figure", says, mouth.floor_px + 96.0, view.simulated},
                frame(mouth) + marks + metres(mouth) + outcome_legend(counts, mouth.floor_px + 64.0), note);
}

}  // namespace trivela::evaluator::page
