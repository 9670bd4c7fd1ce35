#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "evaluator/page/figures/figure.hpp"
#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::page {
namespace {

constexpr double kLeft = 62.0, kRight = 506.0, kTop = 10.0, kBottom = 290.0, kFigureHeight = 336.0;
constexpr std::size_t kBands = 6;         // of set-points
constexpr std::size_t kFewestInBand = 3;  // for a mean with an interval

/// Predicted to cross lower, a ball may touch the floor before the line: those that did not are the higher ones, and
/// their mean would say nothing of the table.
constexpr double kFree_m = 0.3;

/// Observed minus predicted height of a kick that flew freely to the line.
struct HeightError {
  int robot_id = 0;
  double power = 0.0;
  double error_m = 0.0;
};

std::vector<HeightError> height_errors(const PageView& view) {
  std::vector<HeightError> errors;
  for (const PageKick& kick : view.data.kicks) {
    const KickTimeline& timeline = kick.timeline;
    const bool seen = timeline.predicted && timeline.predicted->z_m && timeline.observed && timeline.observed->z_m;
    if (!seen || !timeline.power || *timeline.predicted->z_m < kFree_m || timeline.bounced.value_or(false)) continue;
    errors.push_back({timeline.robot_id, *timeline.power, *timeline.observed->z_m - *timeline.predicted->z_m});
  }
  return errors;
}

/// Mean of errors with Student's 95 % interval.
struct MeanError {
  std::size_t n = 0;
  double power = 0.0, mean_m = 0.0, reach_m = 0.0;
};

MeanError mean_of(const std::vector<HeightError>& errors) {
  MeanError mean{.n = errors.size()};
  const auto n = static_cast<double>(errors.size());
  for (const HeightError& e : errors) {
    mean.power += e.power / n;
    mean.mean_m += e.error_m / n;
  }
  double sum = 0.0;
  for (const HeightError& e : errors) sum += stats::square(e.error_m - mean.mean_m);
  if (errors.size() > 1) mean.reach_m = stats::t_of(stats::kConfidence, n - 1.0) * std::sqrt(sum / (n - 1.0) / n);
  return mean;
}

/// Means by robot over bands of set-points with about as many kicks each; kicks of one set-point stay together.
std::map<int, std::vector<MeanError>> drift_of(std::vector<HeightError> errors) {
  std::map<int, std::vector<HeightError>> by_robot;
  std::ranges::stable_sort(errors, {}, &HeightError::power);
  for (const HeightError& e : errors) by_robot[e.robot_id].push_back(e);
  std::map<int, std::vector<MeanError>> means;
  for (const auto& [robot_id, of] : by_robot) {
    const std::size_t bands = std::clamp<std::size_t>(of.size() / 8, 1, kBands);
    auto from = of.begin();
    for (std::size_t i = 0; i < bands; ++i) {
      auto to = std::max(from, of.begin() + static_cast<std::ptrdiff_t>((i + 1) * of.size() / bands));
      while (to != of.end() && to->power == std::prev(to)->power) ++to;
      if (std::distance(from, to) >= static_cast<std::ptrdiff_t>(kFewestInBand))
        means[robot_id].push_back(mean_of({from, to}));
      from = to;
    }
  }
  return means;
}

std::string drift_figure(const PageView& view, const std::vector<HeightError>& errors) {
  const auto [low_p, high_p] = std::ranges::minmax(errors, {}, &HeightError::power);
  double reach_m = 0.1;
  std::vector<double> sizes;
  sizes.reserve(errors.size());
  for (const HeightError& e : errors) sizes.push_back(std::abs(e.error_m));
  std::ranges::sort(sizes);
  reach_m = std::max(reach_m, sizes[sizes.size() * 49 / 50]);  // a far one does not flatten the others
  const Axis x = axis(low_p.power, high_p.power, kLeft, kRight, "set-point of the robot's table");
  const Axis y = axis(-100.0 * reach_m, 100.0 * reach_m, kBottom, kTop, "observed minus predicted height [cm]");
  std::string svg = axes(x, y) + svg_line("zero", kLeft, y.scale.px(0.0), kRight, y.scale.px(0.0));
  const auto y_px = [&](double m) { return std::clamp(y.scale.px(100.0 * m), kTop, kBottom); };
  if (!view.data.binned()) {
    for (const HeightError& e : errors)
      svg += svg_circle("faint " + colour(static_cast<std::size_t>(e.robot_id)), {x.scale.px(e.power), y_px(e.error_m)},
                        3.0);
  }
  const std::string note = fmt::format(
      "Kicks that were predicted to cross at {:.1f} m or higher and did not touch the floor, {} of {}{}. Full dots are "
      "means over set-points with about as many kicks each, with their 95 % interval: one that lies off the line at 0 "
      "says that the height table has drifted there.",
      kFree_m, errors.size(), view.data.kicks.size(), view.data.binned() ? "" : ": pale dots");
  for (const auto& [robot_id, means] : drift_of(errors)) {
    const std::string kind = colour(static_cast<std::size_t>(robot_id));
    for (const MeanError& mean : means) {
      const double px = x.scale.px(mean.power);
      svg += titled(
          fmt::format("robot {}, about {:.1f}: {:+.1f} cm ± {:.1f} ({} kicks)", robot_id, mean.power,
                      100.0 * mean.mean_m, 100.0 * mean.reach_m, mean.n),
          svg_line(kind + " interval", px, y_px(mean.mean_m - mean.reach_m), px, y_px(mean.mean_m + mean.reach_m)) +
              svg_circle(kind, {px, y_px(mean.mean_m)}, 5.5));
    }
  }
  return figure({"drift-figure", "Observed minus predicted height by set-point", kFigureHeight, view.simulated}, svg,
                note);
}

std::string drift_table(const std::vector<HeightError>& errors) {
  std::vector<std::vector<std::string>> rows{{"robot", "set-point about", "kicks", "mean error", "95 %"}};
  for (const auto& [robot_id, means] : drift_of(errors)) {
    for (const MeanError& mean : means) {
      rows.push_back({std::to_string(robot_id), fmt::format("{:.1f}", mean.power), std::to_string(mean.n),
                      fmt::format("{:+.1f} cm", 100.0 * mean.mean_m),
                      fmt::format("{:+.1f} to {:+.1f} cm", 100.0 * (mean.mean_m - mean.reach_m),
                                  100.0 * (mean.mean_m + mean.reach_m))});
    }
  }
  return rows.size() > 1 ? details("The same in numbers", table("Height, observed minus predicted", rows)) : "";
}

std::string reliability_figure(const PageView& view, const std::vector<PredictedChance>& predictions, const char* id,
                               const std::string& what) {
  struct Band {
    stats::Counts counts;
    double p_sum = 0.0;
  };
  std::array<Band, 10> bands{};
  double expected = 0.0;
  for (const PredictedChance& chance : predictions) {
    Band& band = bands[static_cast<std::size_t>(std::clamp(10.0 * chance.p, 0.0, 9.0))];
    ++band.counts.n;
    band.counts.inside += chance.came ? 1 : 0;
    band.p_sum += chance.p;
    expected += chance.p;
  }
  const Axis x = axis(0.0, 100.0, kLeft, kRight, fmt::format("predicted P({}) [%]", what));
  const Axis y = axis(0.0, 100.0, kBottom, kTop, what + " [%]");
  std::string svg = axes(x, y) + svg_line("zero", kLeft, kBottom, kRight, kTop);
  std::int64_t inside = 0;
  for (const Band& band : bands) {
    if (band.counts.n == 0) continue;
    inside += band.counts.inside;
    const auto n = static_cast<double>(band.counts.n);
    const auto ci = stats::wilson(band.counts);
    const double px = x.scale.px(100.0 * band.p_sum / n);
    const double share = static_cast<double>(band.counts.inside) / n;
    svg += titled(
        fmt::format("predicted {}: {} of {} {}", percent(band.p_sum / n), band.counts.inside, band.counts.n, what),
        svg_line("c0 interval", px, y.scale.px(100.0 * ci.lo), px, y.scale.px(100.0 * ci.hi)) +
            svg_circle("c0", {px, y.scale.px(100.0 * share)}, 5.5));
  }
  const std::string note = fmt::format(
      "Kicks in ten bands of the probability that the physical model gave them beforehand. On the diagonal, kicks come "
      "as often as predicted; below it the model promised too much. Over all: {:.1f} of {} predicted, {} came.",
      expected, predictions.size(), inside);
  return figure({id, fmt::format("Predicted probability against the share: {}", what), kFigureHeight, view.simulated},
                svg, note);
}

}  // namespace

std::string prediction_section(const PageView& view) {
  const auto errors = height_errors(view);
  std::string body = "<h3>Height by set-point</h3>\n";
  body +=
      errors.empty()
          ? paragraphs({"No kick has both a predicted height of 0.3 m or more and an observed one without a bounce."})
          : drift_figure(view, errors) + drift_table(errors);
  body += "<h3>Probability of a shot on target</h3>\n";
  body += view.data.predictions.empty()
              ? paragraphs({"No kick was given a probability: the predictive policy neither played nor rode along."})
              : reliability_figure(view, view.data.predictions, "reliability-figure", "on target");
  if (!view.data.predicted_goals.empty()) {
    body += "<h3>Probability of a goal past the keeper</h3>\n";
    body += reliability_figure(view, view.data.predicted_goals, "goal-reliability-figure", "goal");
  }
  return body;
}

}  // namespace trivela::evaluator::page
