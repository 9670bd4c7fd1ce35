#pragma once

#include <string>
#include <vector>

#include "evaluator/render/svg_chart.hpp"

namespace trivela::evaluator {

/// How every figure begins: its size, its title for who hovers, paper, and the style sheet with colours for light and
/// for dark readers, `more_style` behind it.
std::string svg_head(double width, double height, const std::string& title, const std::string& more_style = "");

/// Classes of a series' marks in the style sheet.
std::string svg_class(const ChartSeries& series);

// Marks, places in pixels. `anchor`: start, middle, end; `more`: further attributes, with a blank in front.
std::string svg_text(double x, double y, const char* anchor, const std::string& words, const std::string& more = "");
std::string svg_line(const std::string& kind, double x1, double y1, double x2, double y2);
std::string svg_polyline(const std::string& kind, const std::vector<ChartPoint>& points);
std::string svg_circle(const std::string& kind, const ChartPoint& centre, double radius);
std::string svg_rect(const std::string& kind, const ChartPoint& corner, double width, double height);

}  // namespace trivela::evaluator
