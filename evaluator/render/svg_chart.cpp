#include "evaluator/render/svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "evaluator/render/text_table.hpp"

namespace trivela::evaluator {
namespace {

constexpr double kLeft = 76.0, kTop = 48.0, kPlotWidth = 660.0, kPlotHeight = 420.0, kBottom = 64.0;
constexpr double kLegendGap = 24.0, kLegendRow = 20.0, kSampleWidth = 34.0, kLetterWidth = 8.0;
constexpr auto kLegendRows = static_cast<std::size_t>(kPlotHeight / kLegendRow);

/// A band for each category.
Axis bands_of(const Chart& chart, double from_px, double to_px) {
  std::vector<double> places;
  for (std::size_t i = 0; i < chart.x_categories.size(); ++i) places.push_back(static_cast<double>(i));
  return {{-0.5, places.back() + 0.5, from_px, to_px}, places, chart.x_label};
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
  return axis(low, high, from_px, to_px, coordinate == &ChartPoint::x ? chart.x_label : chart.y_label);
}

std::string axes(const Chart& chart, const Axis& x, const Axis& y) {
  const double bottom = y.scale.from_px, top = y.scale.to_px, left = x.scale.from_px, right = x.scale.to_px;
  std::string svg;
  for (std::size_t i = 0; i < x.ticks.size(); ++i) {
    const double px = x.scale.px(x.ticks[i]);
    const bool category = !chart.x_categories.empty();
    if (!category) svg += svg_line("grid", px, bottom, px, top);
    svg += svg_text(px, bottom + 20.0, "middle", category ? chart.x_categories[i] : tick_text(x.ticks[i]));
  }
  for (const double tick : y.ticks) {
    svg += svg_line("grid", left, y.scale.px(tick), right, y.scale.px(tick));
    svg += svg_text(left - 8.0, y.scale.px(tick) + 5.0, "end", tick_text(tick));
  }
  svg += svg_line("axis", left, bottom, right, bottom) + svg_line("axis", left, bottom, left, top);
  const double middle_x = 0.5 * (left + right);
  const double middle_y = 0.5 * (bottom + top);
  svg += svg_text(middle_x, kTop - 26.0, "middle", chart.title, " class=\"title\"");
  if (chart.simulated) svg += svg_text(middle_x, kTop - 8.0, "middle", kSimulatedFigure);
  svg += svg_text(middle_x, bottom + 46.0, "middle", x.label);
  svg += svg_text(20.0, middle_y, "middle", y.label, fmt::format(" transform=\"rotate(-90 20 {:.1f})\"", middle_y));
  return svg;
}

// After Okabe and Ito (2008), darkened where white paper, lightened where a dark screen would swallow them.
constexpr std::array<std::pair<const char*, const char*>, 8> kColours{{{"#0072b2", "#4da3e0"},
                                                                       {"#d55e00", "#ff7f32"},
                                                                       {"#009e73", "#2cc79b"},
                                                                       {"#b8588f", "#e6a8cb"},
                                                                       {"#a87800", "#e6b422"},
                                                                       {"#2f93d1", "#9ad4f7"},
                                                                       {"#222222", "#eeeeee"},
                                                                       {"#7a5c3a", "#c8a57a"}}};
constexpr std::array<const char*, 4> kDashes{"none", "7 4", "2 4", "10 3 2 3"};

std::string svg_class(const ChartSeries& series) {
  const auto colours = static_cast<int>(kColours.size());
  std::string style = fmt::format("c{}", series.colour % colours);
  if (series.colour >= colours) style += " thin";
  if (const int dash = series.dash % static_cast<int>(kDashes.size()); dash > 0) style += fmt::format(" d{}", dash);
  return style;
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

std::string style() {
  std::string light =
      "text{font:14px sans-serif;fill:#222}\n.title{font-size:17px;font-weight:600}\n.paper{fill:#fff}\n"
      ".grid{stroke:#ddd}\n.axis{stroke:#444;stroke-width:1.5}\npolyline{fill:none;stroke-width:2.4}\n"
      "polyline.thin{stroke-width:1.2}\ncircle{stroke:none}\n";
  std::string dark = "text{fill:#ddd}\n.paper{fill:#161616}\n.grid{stroke:#383838}\n.axis{stroke:#aaa}\n";
  for (std::size_t i = 0; i < kColours.size(); ++i) {
    const auto& [on_white, on_black] = kColours[i];
    light += fmt::format("polyline.c{0}{{stroke:{1}}}\ncircle.c{0}{{fill:{1}}}\n", i, on_white);
    dark += fmt::format("polyline.c{0}{{stroke:{1}}}\ncircle.c{0}{{fill:{1}}}\n", i, on_black);
  }
  for (std::size_t i = 1; i < kDashes.size(); ++i) {
    light += fmt::format("polyline.d{}{{stroke-dasharray:{}}}\n", i, kDashes[i]);
  }
  return light + "@media (prefers-color-scheme:dark){\n" + dark + "}\n";
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

std::string tick_text(double value) { return fmt::format("{:.6g}", std::abs(value) < 1e-9 ? 0.0 : value); }

Axis axis(double low, double high, double from_px, double to_px, const std::string& label) {
  const auto ticks = round_ticks(low, high);
  return {{ticks.front(), ticks.back(), from_px, to_px}, ticks, label};
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
    for (const ChartPoint& point : series.points) pixels.push_back({x.scale.px(point.x), y.scale.px(point.y)});
    svg += marks(series, pixels);
  }
  return svg + legend(chart, legend_x) + "</svg>\n";
}

std::string svg_head(double width, double height, const std::string& title, const std::string& more_style) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n<title>{2}</title>\n<style>\n{3}{4}</style>\n"
      "<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n",
      width, height, xml_text(title, false), style(), more_style);
}

std::string svg_text(double x, double y, const char* anchor, const std::string& words, const std::string& more) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                     xml_text(words, false));
}

std::string svg_line(const std::string& kind, double x1, double y1, double x2, double y2) {
  return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind, x1, y1, x2,
                     y2);
}

std::string svg_polyline(const std::string& kind, const std::vector<ChartPoint>& points) {
  std::string svg = fmt::format("<polyline class=\"{}\" points=\"", kind);
  for (const ChartPoint& p : points) svg += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
  return svg + "\"/>\n";
}

std::string svg_circle(const std::string& kind, const ChartPoint& centre, double radius) {
  return fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.3g}\"/>\n", kind, centre.x, centre.y,
                     radius);
}

std::string svg_rect(const std::string& kind, const ChartPoint& corner, double width, double height) {
  return fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", kind,
                     corner.x, corner.y, width, height);
}

}  // namespace trivela::evaluator
