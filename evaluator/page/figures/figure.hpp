#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "evaluator/render/svg_chart.hpp"

namespace trivela::evaluator::page {

inline constexpr double kFigureWidth = 520.0;  ///< of every figure, in its own units; a telephone shows it at 0.7

/// What every figure of the page has.
struct FigureHead {
  std::string id;
  std::string says;  ///< for who hears the page
  double height = 0.0;
  bool simulated = false;
};

/// A figure: `marks` are SVG, the note beneath it plain text. Where the data are simulated it says so, in its lowest
/// line. Colours are the page's, so that it is light, dark or printed as the page is.
std::string figure(const FigureHead& head, const std::string& marks, const std::string& note);

/// A mark with words for who points at it: <g class="kind" ...><title>...</title>mark</g>.
std::string titled(const std::string& words, const std::string& mark, const std::string& attributes = "");

/// Grid, numbers and labels of two axes; x runs along the bottom.
std::string axes(const Axis& x, const Axis& y);

/// Class of the colour with a number: eight, then again.
std::string colour(std::size_t number);

/// A line of an interval plot: heading, or value with its interval.
struct IntervalRow {
  std::string label;
  bool heading = false;
  bool known = true;  ///< false: there is nothing to draw
  double value = 0.0, lo = 0.0, hi = 0.0;
  std::string numbers{};  ///< beside it
  std::size_t colour = 0;
};

/// Values with their intervals beneath each other (a forest plot), on one axis.
struct IntervalPlot {
  FigureHead head;  ///< the height follows from the rows
  std::string axis_label;
  double from = 0.0, to = 1.0;
  double unit = 1.0;  ///< a tick shows value / unit
  std::vector<IntervalRow> rows{};
  std::string note;
};
std::string interval_plot(IntervalPlot plot);

/// Counts of points in square cells, where there are too many points to draw.
class HeatMap {
 public:
  explicit HeatMap(double cell_m) : cell_m_(cell_m) {}

  void add(double x_m, double y_m);

  /// Cells as squares of class `kind`, the fuller the less transparent; y upwards by `y`.
  std::string draw(const std::string& kind, const Scale& x, const Scale& y) const;

  std::size_t fullest() const;

 private:
  double cell_m_;
  std::map<std::pair<long, long>, std::size_t> cells_;
};

}  // namespace trivela::evaluator::page
