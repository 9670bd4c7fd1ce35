#pragma once

#include <string>
#include <vector>

#include "evaluator/render/svg_style.hpp"

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

/// A number without trailing zeros: "0.3", "-2".
std::string tick_text(double value);

}  // namespace trivela::evaluator::page
