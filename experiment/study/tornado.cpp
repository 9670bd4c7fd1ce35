#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluator/render/simulated.hpp"
#include "evaluator/render/svg_chart.hpp"
#include "experiment/study/sensitivity.hpp"

namespace trivela::experiment {
namespace {

constexpr double kNames = 300.0, kPanel = 320.0, kGap = 56.0, kTop = 84.0, kRow = 24.0, kBottom = 64.0;
constexpr std::size_t kMostRows = 20;  // the smallest are in the table

std::string line(const char* kind, double x1, double y1, double x2, double y2) {
  return fmt::format("<polyline class=\"{}\" points=\"{:.1f},{:.1f} {:.1f},{:.1f}\"/>\n", kind, x1, y1, x2, y2);
}

/// One headline: its axis and a bar for each end of each input.
class Panel {
 public:
  Panel(const SensitivityReport& report, std::size_t headline, std::size_t rows)
      : report_(report),
        headline_(headline),
        rows_(rows),
        left_(kNames + (kPanel + kGap) * static_cast<double>(headline)) {
    double low = 0.0, high = 0.0;
    for (std::size_t row = 0; row < rows_; ++row) {
      for (const PlayedEnd& end : report.inputs[row].ends) {
        const Effect moved = change(report, end, headline);
        const bool has_ends = has_interval(moved);
        low = std::min(low, 100.0 * (has_ends ? moved.ci.lo : moved.value));
        high = std::max(high, 100.0 * (has_ends ? moved.ci.hi : moved.value));
      }
    }
    axis_ = evaluator::axis(low, high, left_, left_ + kPanel, "");
  }

  std::string draw() const {
    const double bottom = kTop + kRow * static_cast<double>(rows_);
    std::string svg = evaluator::svg_text(left_ + 0.5 * kPanel, kTop - 14.0, "middle",
                                          report_.arms[headline_ + 1] + " - " + report_.arms[headline_]);
    for (const double tick : axis_.ticks) {
      svg += fmt::format("<line class=\"{0}\" x1=\"{1:.1f}\" y1=\"{2:.1f}\" x2=\"{1:.1f}\" y2=\"{3:.1f}\"/>\n",
                         std::abs(tick) < 1e-9 ? "axis" : "grid", px(tick), kTop, bottom);
      svg += evaluator::svg_text(px(tick), bottom + 20.0, "middle", evaluator::tick_text(tick));
    }
    for (std::size_t row = 0; row < rows_; ++row) svg += bars(row);
    return svg;
  }

 private:
  double px(double points) const { return axis_.scale.px(points); }

  std::string bars(std::size_t row) const {
    const PlayedInput& input = report_.inputs[row];
    std::string svg;
    for (const PlayedEnd& end : input.ends) {
      const bool low = end.value < input.value;
      const double y = kTop + kRow * (static_cast<double>(row) + (low ? 0.32 : 0.68));
      const Effect moved = change(report_, end, headline_);
      svg += line(low ? "bar c0" : "bar c1", px(0.0), y, px(100.0 * moved.value), y);
      if (has_interval(moved)) svg += line("whisker c6", px(100.0 * moved.ci.lo), y, px(100.0 * moved.ci.hi), y);
    }
    return svg;
  }

  const SensitivityReport& report_;
  std::size_t headline_;
  std::size_t rows_;
  double left_;
  evaluator::Axis axis_;
};

}  // namespace

std::string to_svg(const SensitivityReport& report) {
  const std::size_t rows = std::min(report.inputs.size(), kMostRows), panels = report.arms.size() - 1;
  const double width = kNames + (kPanel + kGap) * static_cast<double>(panels);
  const double bottom = kTop + kRow * static_cast<double>(rows);
  std::string svg = evaluator::svg_head(width, bottom + kBottom, "Sensitivity",
                                        "polyline.bar{stroke-width:8}\npolyline.whisker{stroke-width:1.2}\n");
  svg += evaluator::svg_text(0.5 * width, 28.0, "middle",
                             report.measure == Measure::kGoals
                                 ? "Change of the difference in goals, points of 100 opportunities"
                                 : "Change of the difference in shots on target, points of 100 opportunities",
                             " class=\"title\"");
  svg += evaluator::svg_text(0.5 * width, 46.0, "middle", evaluator::kSimulatedFigure);
  svg += line("bar c0", 20.0, 54.0, 50.0, 54.0) + evaluator::svg_text(58.0, 59.0, "start", "low") +
         line("bar c1", 100.0, 54.0, 130.0, 54.0) + evaluator::svg_text(138.0, 59.0, "start", "high");
  for (std::size_t row = 0; row < rows; ++row) {
    svg += evaluator::svg_text(kNames - 14.0, kTop + kRow * (static_cast<double>(row) + 0.5) + 5.0, "end",
                               report.inputs[row].input.key);
  }
  for (std::size_t i = 0; i < panels; ++i) svg += Panel{report, i, rows}.draw();
  return svg + "</svg>\n";
}

}  // namespace trivela::experiment
