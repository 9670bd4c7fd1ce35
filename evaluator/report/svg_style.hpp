#pragma once

#include <string>

#include "evaluator/report/svg_chart.hpp"

namespace trivela::evaluator {

/// The style sheet of every chart: colours for light and for dark readers.
std::string svg_style();

/// Classes of a series' marks in it.
std::string svg_class(const ChartSeries& series);

}  // namespace trivela::evaluator
