#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluator/counting/kick_dataset.hpp"
#include "evaluator/render/svg_chart.hpp"
#include "evaluator/render/text_table.hpp"
#include "experiment/study/study.hpp"

namespace trivela::experiment {
namespace {

constexpr double kTop = 108.0, kPanel = 340.0, kGap = 48.0, kMark = 4.6, kRowGap = 9.0, kBottom = 40.0, kLetter = 7.4;
constexpr std::size_t kMostLines = 40;

/// A number at its line and in its series' colour; one for each row and panel.
struct Mark {
  std::size_t line = 0, series = 0;
  Effect effect;
};

/// Lines and series as the rows name them.
struct Names {
  std::vector<std::string> lines, series;
  std::vector<Mark> places;  ///< a row's each, without its number

  Names(const std::vector<StudyRow>& rows, const std::string& by) {
    for (const StudyRow& row : rows) {
      std::string line, colour;
      for (const KeyText& label : row.labels) {
        const bool varies =
            std::ranges::any_of(rows, [&](const StudyRow& other) { return other.label(label.key) != label.text; });
        if (label.key == by) colour = label.text;
        if (label.key != by && varies) line += (line.empty() ? "" : " ") + label.text;
      }
      places.push_back({evaluator::place_of(lines, line), evaluator::place_of(series, colour), {}});
    }
    lines.resize(std::min(lines.size(), kMostLines));
  }
  double line_height() const { return kRowGap + kMark * static_cast<double>(series.size()); }
  double bottom() const { return kTop + line_height() * static_cast<double>(lines.size()); }
};

std::string colour(std::size_t series) { return fmt::format("c{}", series % 8); }

std::string panel_of(const std::string& title, const std::vector<Mark>& marks, const Names& names, double left) {
  double low = 0.0, high = 0.0;
  for (const Mark& mark : marks) {
    const auto& [value, ci] = mark.effect;
    low = std::min(low, 100.0 * (has_interval(mark.effect) ? ci.lo : value));
    high = std::max(high, 100.0 * (has_interval(mark.effect) ? ci.hi : value));
  }
  const evaluator::Axis axis = evaluator::axis(low, high, left, left + kPanel, "");
  std::string svg = evaluator::svg_text(left + 0.5 * kPanel, kTop - 14.0, "middle", title);
  for (const double tick : axis.ticks) {
    const double x = axis.scale.px(tick);
    svg += evaluator::svg_line(std::abs(tick) < 1e-9 ? "axis" : "grid", x, kTop, x, names.bottom());
    svg += evaluator::svg_text(x, names.bottom() + 20.0, "middle", evaluator::tick_text(tick));
  }
  for (const Mark& mark : marks) {
    const double y = kTop + names.line_height() * static_cast<double>(mark.line) + 0.5 * kRowGap +
                     kMark * (static_cast<double>(mark.series) + 0.5);
    const auto px = [&](double share) { return axis.scale.px(100.0 * share); };
    if (has_interval(mark.effect))
      svg += evaluator::svg_polyline(colour(mark.series), {{px(mark.effect.ci.lo), y}, {px(mark.effect.ci.hi), y}});
    svg += evaluator::svg_circle(colour(mark.series), {px(mark.effect.value), y}, 3.0);
  }
  return svg;
}

/// Title, legend and names of the lines.
std::string frame_of(const Names& names, double left, double width) {
  std::string svg = evaluator::svg_head(width, names.bottom() + kBottom, "Study", "polyline{stroke-width:1.6}\n") +
                    evaluator::svg_text(0.5 * width, 30.0, "middle", evaluator::kSimulatedFigure);
  double x = 20.0;
  for (std::size_t series = 0; series < names.series.size() && names.series.size() > 1; ++series) {
    svg += evaluator::svg_circle(colour(series), {x + 5.0, 53.0}, 5.0);
    svg += evaluator::svg_text(x + 16.0, 58.0, "start", names.series[series]);
    x += 44.0 + kLetter * static_cast<double>(names.series[series].size());
  }
  for (std::size_t line = 0; line < names.lines.size(); ++line) {
    const double y = kTop + names.line_height() * static_cast<double>(line);
    svg += evaluator::svg_line("grid", 12.0, y, width - 12.0, y);
    svg += evaluator::svg_text(left - 16.0, y + 0.5 * names.line_height() + 5.0, "end", names.lines[line]);
  }
  return svg;
}

}  // namespace

std::string chart_of(const std::vector<StudyRow>& rows, const std::string& series, const std::vector<Measure>& measures,
                     const std::vector<KeyText>& changes) {
  const Names names{rows, series};
  std::size_t letters = 0;
  for (const std::string& line : names.lines) letters = std::max(letters, line.size());
  const double left = 40.0 + kLetter * static_cast<double>(letters);
  std::vector<std::string> titles;
  titles.reserve(measures.size() + changes.size());
  for (const Measure measure : measures) titles.emplace_back(name_of(measure));
  for (const KeyText& change : changes) titles.push_back(change.text + " [points]");
  std::vector<std::vector<Mark>> marks(titles.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<Effect> effects;
    effects.reserve(titles.size());
    for (const Measure measure : measures) effects.push_back(share_of(rows[i].matches, measure));
    effects.insert(effects.end(), rows[i].changes.begin(), rows[i].changes.end());
    Mark mark = names.places[i];
    for (std::size_t panel = 0; panel < std::min(effects.size(), titles.size()) && mark.line < kMostLines; ++panel) {
      mark.effect = effects[panel];
      if (std::isfinite(mark.effect.value)) marks[panel].push_back(mark);
    }
  }
  std::string svg = frame_of(names, left, left + (kPanel + kGap) * static_cast<double>(titles.size()));
  for (std::size_t panel = 0; panel < titles.size(); ++panel)
    svg += panel_of(titles[panel], marks[panel], names, left + (kPanel + kGap) * static_cast<double>(panel));
  return svg + "</svg>\n";
}

}  // namespace trivela::experiment
