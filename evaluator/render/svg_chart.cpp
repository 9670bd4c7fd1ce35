#include "evaluator/render/svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "evaluator/render/simulated.hpp"
#include "evaluator/render/svg_style.hpp"

namespace trivela::evaluator {
namespace {

constexpr double kLeft = 76.0, kTop = 48.0, kPlotWidth = 660.0, kPlotHeight = 420.0, kBottom = 64.0;
constexpr double kLegendGap = 24.0, kLegendRow = 20.0, kSampleWidth = 34.0, kLetterWidth = 8.0;
constexpr auto kLegendRows = static_cast<std::size_t>(kPlotHeight / kLegendRow);

/// One axis: its ticks, and values to pixels.
struct Axis {
  std::vector<double> ticks;
  double from_px = 0.0;
  double to_px = 0.0;
  double margin = 0.0;  ///< in front of the first tick and behind the last

  double px(double value) const {
    const double from = ticks.front() - margin, to = ticks.back() + margin;
    return from_px + (to_px - from_px) * (value - from) / (to - from);
  }
};

/// A band for each category.
Axis bands_of(const Chart& chart, double from_px, double to_px) {
  std::vector<double> places;
  for (std::size_t i = 0; i < chart.x_categories.size(); ++i) places.push_back(static_cast<double>(i));
  return {places, from_px, to_px, 0.5};
}

Axis axis_of(const Chart& chart, double ChartPoint::*coordinate, double from_px, double to_px) {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      if (!std::isfinite(point.*coordinate)) throw std::invalid_argument("chart: a point is not finite");
      low = std::min(low, point.*coordinate);
      high = std::max(high, point.*coordinate);
    }
  }
  if (low > high) throw std::invalid_argument("chart: no points");
  return {round_ticks(low, high), from_px, to_px, 0.0};
}

/// A tick without the noise of its sum: "0.3", "-2", "10".
std::string tick_label(double value) { return fmt::format("{:.6g}", std::abs(value) < 1e-12 ? 0.0 : value); }

std::string axes(const Chart& chart, const Axis& x, const Axis& y) {
  std::string svg;
  for (std::size_t i = 0; i < x.ticks.size(); ++i) {
    const double px = x.px(x.ticks[i]);
    const bool category = !chart.x_categories.empty();
    if (!category) svg += svg_line("grid", px, y.from_px, px, y.to_px);
    svg += svg_text(px, y.from_px + 20.0, "middle", category ? chart.x_categories[i] : tick_label(x.ticks[i]));
  }
  for (const double tick : y.ticks) {
    svg += svg_line("grid", x.from_px, y.px(tick), x.to_px, y.px(tick));
    svg += svg_text(x.from_px - 8.0, y.px(tick) + 5.0, "end", tick_label(tick));
  }
  svg += svg_line("axis", x.from_px, y.from_px, x.to_px, y.from_px) +
         svg_line("axis", x.from_px, y.from_px, x.from_px, y.to_px);
  const double middle_x = 0.5 * (x.from_px + x.to_px);
  const double middle_y = 0.5 * (y.from_px + y.to_px);
  svg += svg_text(middle_x, kTop - 26.0, "middle", chart.title, " class=\"title\"");
  if (chart.simulated) svg += svg_text(middle_x, kTop - 8.0, "middle", kSimulatedFigure);
  svg += svg_text(middle_x, y.from_px + 46.0, "middle", chart.x_label);
  svg +=
      svg_text(20.0, middle_y, "middle", chart.y_label, fmt::format(" transform=\"rotate(-90 20 {:.1f})\"", middle_y));
  return svg;
}

std::string marks(const ChartSeries& series, const std::vector<ChartPoint>& pixels) {
  const std::string style = svg_class(series);
  if (series.mark == ChartMark::kDots) {
    std::string svg;
    for (const ChartPoint& p : pixels) svg += svg_circle(style, p, 4.0);
    return svg;
  }
  return svg_polyline(style, pixels);
}

double column_width(const Chart& chart) {
  std::size_t letters = 0;
  for (const ChartSeries& series : chart.series) letters = std::max(letters, series.name.size());
  return kSampleWidth + 10.0 + kLetterWidth * static_cast<double>(letters) + 14.0;
}

std::string legend(const Chart& chart, double x0) {
  std::string svg;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const std::size_t column = i / kLegendRows;
    const double x = x0 + column_width(chart) * static_cast<double>(column);
    const double y = kTop + kLegendRow * (0.5 + static_cast<double>(i % kLegendRows));
    const ChartSeries& series = chart.series[i];
    const bool dots = series.mark == ChartMark::kDots;
    svg += marks(series, dots ? std::vector<ChartPoint>{{x + 0.5 * kSampleWidth, y}}
                              : std::vector<ChartPoint>{{x, y}, {x + kSampleWidth, y}});
    svg += svg_text(x + kSampleWidth + 10.0, y + 5.0, "start", series.name);
  }
  return svg;
}

}  // namespace

std::vector<double> round_ticks(double low, double high) {
  const double largest = std::max(std::abs(low), std::abs(high));
  if (high - low <= 1e-9 * largest) {  // one value: half of it to either side, of 0 the unit above
    low -= 0.5 * largest;
    high += largest > 0.0 ? 0.5 * largest : 1.0;
  }
  const double span = high - low;
  const double power = std::pow(10.0, std::floor(std::log10(span / 5.0)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0}) {
    if (span / step > 9.0) step = factor * power;
  }
  std::vector<double> ticks;
  const double first = std::floor(low / step + 1e-9);
  const double last = std::max(first + 1.0, std::ceil(high / step - 1e-9));
  for (double i = first; i <= last; i += 1.0) ticks.push_back(i * step);
  return ticks;
}

std::string to_svg(const Chart& chart) {
  const Axis x = chart.x_categories.empty() ? axis_of(chart, &ChartPoint::x, kLeft, kLeft + kPlotWidth)
                                            : bands_of(chart, kLeft, kLeft + kPlotWidth);
  const Axis y = axis_of(chart, &ChartPoint::y, kTop + kPlotHeight, kTop);
  const double legend_x = kLeft + kPlotWidth + kLegendGap;
  const std::size_t columns = (chart.series.size() + kLegendRows - 1) / kLegendRows;
  const double width = legend_x + static_cast<double>(columns) * column_width(chart);
  const double height = kTop + kPlotHeight + kBottom;
  std::string svg = svg_head(width, height, chart.title) + axes(chart, x, y);
  for (const ChartSeries& series : chart.series) {
    std::vector<ChartPoint> pixels;
    for (const ChartPoint& point : series.points) pixels.push_back({x.px(point.x), y.px(point.y)});
    svg += marks(series, pixels);
  }
  return svg + legend(chart, legend_x) + "</svg>\n";
}

}  // namespace trivela::evaluator
