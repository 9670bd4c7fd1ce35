#pragma once

#include <string>
#include <vector>

namespace trivela::evaluator {

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
};

enum class ChartMark { kLine, kDots };

/// Points that belong together, under one name in the legend.
struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;
  ChartMark mark = ChartMark::kLine;
  int colour = 0;  ///< eight that colour-blind readers tell apart; from the ninth on again, thinner
  int dash = 0;    ///< 0 solid, then three patterns
};

struct Chart {
  std::string title;
  std::string x_label;  ///< with its unit: "vx [m/s]"
  std::string y_label;
  std::vector<ChartSeries> series;
  std::vector<std::string> x_categories{};  ///< not empty: x is the place of a category, 0 and so on, and has no scale
  bool simulated = false;                   ///< the chart says so
};

/// The chart as SVG of its own: ticks at round numbers, the legend beside the axes, light or dark as the reader's
/// system is. Throws std::invalid_argument where no series has a point or a point is not finite.
std::string to_svg(const Chart& chart);

/// Round numbers (1, 2 or 5 times a power of ten apart) from at or below `low` to at or above `high`, five to eleven of
/// them.
std::vector<double> round_ticks(double low, double high);

/// Linear: values to pixels.
struct Scale {
  double from = 0.0, to = 1.0;
  double from_px = 0.0, to_px = 1.0;

  double px(double value) const { return from_px + (to_px - from_px) * (value - from) / (to - from); }
  double length_px(double value) const { return px(from + value) - from_px; }
};

/// A scale over round numbers that `low` and `high` lie within, and these numbers.
struct Axis {
  Scale scale;
  std::vector<double> ticks;
  std::string label;  ///< with its unit
};
Axis axis(double low, double high, double from_px, double to_px, const std::string& label);

/// A tick without the noise of its sum: "0.3", "-2", "10".
std::string tick_text(double value);

/// How every figure begins: its size, its title for who hovers, paper, and the style sheet with colours for light and
/// for dark readers, `more_style` behind it.
std::string svg_head(double width, double height, const std::string& title, const std::string& more_style = "");

// Marks, places in pixels. `anchor`: start, middle, end; `more`: further attributes, with a blank in front.
std::string svg_text(double x, double y, const char* anchor, const std::string& words, const std::string& more = "");
std::string svg_line(const std::string& kind, double x1, double y1, double x2, double y2);
std::string svg_polyline(const std::string& kind, const std::vector<ChartPoint>& points);
std::string svg_circle(const std::string& kind, const ChartPoint& centre, double radius);
std::string svg_rect(const std::string& kind, const ChartPoint& corner, double width, double height);

}  // namespace trivela::evaluator
