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

}  // namespace trivela::evaluator
