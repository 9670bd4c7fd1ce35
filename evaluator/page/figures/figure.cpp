#include "evaluator/page/figures/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluator/page/html.hpp"
#include "evaluator/render/text_table.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::evaluator::page {
namespace {

constexpr double kNoteHeight = 22.0;
constexpr std::size_t kPageColours = 8;

}  // namespace

std::string figure(const FigureHead& head, const std::string& marks, const std::string& note) {
  const double height = head.height + (head.simulated ? kNoteHeight : 0.0);
  const std::string said =
      head.simulated ? svg_text(0.5 * kFigureWidth, height - 6.0, "middle", kSimulatedFigure, " class=\"simulated\"")
                     : std::string();
  return fmt::format(
      "<figure id=\"{}\">\n<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n{}{}</svg>\n"
      "<figcaption>{}</figcaption>\n</figure>\n",
      head.id, kFigureWidth, height, html(head.says + (head.simulated ? " (simulated)" : "")), marks, said, html(note));
}

std::string titled(const std::string& words, const std::string& mark, const std::string& attributes) {
  return fmt::format("<g{}><title>{}</title>{}</g>\n", attributes, html(words), mark);
}

std::string axes(const Axis& x, const Axis& y) {
  std::string svg;
  const double bottom = y.scale.from_px, top = y.scale.to_px, left = x.scale.from_px, right = x.scale.to_px;
  const std::size_t every = x.ticks.size() > 8 ? 2 : 1;
  for (std::size_t i = 0; i < x.ticks.size(); ++i) {
    const double px = x.scale.px(x.ticks[i]);
    svg += svg_line("grid", px, bottom, px, top);
    if (i % every == 0) svg += svg_text(px, bottom + 22.0, "middle", tick_text(x.ticks[i]));
  }
  for (const double tick : y.ticks) {
    svg += svg_line("grid", left, y.scale.px(tick), right, y.scale.px(tick));
    svg += svg_text(left - 7.0, y.scale.px(tick) + 5.0, "end", tick_text(tick));
  }
  svg += svg_line("axis", left, bottom, right, bottom) + svg_line("axis", left, bottom, left, top);
  const double middle = 0.5 * (bottom + top);
  svg += svg_text(0.5 * (left + right), bottom + 41.0, "middle", x.label);
  svg += svg_text(14.0, middle, "middle", y.label, fmt::format(" transform=\"rotate(-90 14 {:.1f})\"", middle));
  return svg;
}

std::string colour(std::size_t number) { return fmt::format("c{}", number % kPageColours); }

std::string interval_plot(IntervalPlot plot) {
  constexpr double kLeft = 190.0, kRight = 372.0, kRow = 24.0, kTop = 8.0;
  const double bottom = kTop + kRow * static_cast<double>(plot.rows.size());
  const Axis x = axis(plot.from / plot.unit, plot.to / plot.unit, kLeft, kRight, plot.axis_label);
  std::string svg;
  const std::size_t every = x.ticks.size() > 6 ? 2 : 1;
  for (std::size_t i = 0; i < x.ticks.size(); ++i) {
    const double px = x.scale.px(x.ticks[i]);
    svg += svg_line("grid", px, kTop, px, bottom);
    if (i % every == 0) svg += svg_text(px, bottom + 18.0, "middle", tick_text(x.ticks[i]));
  }
  svg += svg_line("axis", kLeft, bottom, kRight, bottom);
  svg += svg_text(0.5 * (kLeft + kRight), bottom + 38.0, "middle", plot.axis_label);
  const auto px_of = [&](double value) { return std::clamp(x.scale.px(value / plot.unit), kLeft, kRight); };
  double y = kTop + 0.5 * kRow;
  for (const IntervalRow& row : plot.rows) {
    const std::string label = kicking::printable(row.label);
    svg += svg_text(row.heading ? 4.0 : 16.0, y + 5.0, "start", label, row.heading ? " class=\"heading\"" : "");
    if (!row.heading && row.known) {
      svg += titled(fmt::format("{}: {}", row.label, row.numbers),
                    svg_line(colour(row.colour) + " interval", px_of(row.lo), y, px_of(row.hi), y) +
                        svg_circle(colour(row.colour), {px_of(row.value), y}, 5.0));
    }
    if (!row.heading) svg += svg_text(kRight + 9.0, y + 5.0, "start", row.numbers);
    y += kRow;
  }
  plot.head.height = bottom + 48.0;
  return figure(plot.head, svg, plot.note);
}

void HeatMap::add(double x_m, double y_m) {
  ++cells_[{std::lround(std::floor(x_m / cell_m_)), std::lround(std::floor(y_m / cell_m_))}];
}

std::size_t HeatMap::fullest() const {
  std::size_t most = 0;
  for (const auto& [cell, n] : cells_) most = std::max(most, n);
  return most;
}

std::string HeatMap::draw(const std::string& kind, const Scale& x, const Scale& y) const {
  const auto most = static_cast<double>(fullest());
  std::string svg;
  for (const auto& [cell, n] : cells_) {
    const double left = cell_m_ * static_cast<double>(cell.first);
    const double low = cell_m_ * static_cast<double>(cell.second);
    const double width = x.length_px(cell_m_), height = -y.length_px(cell_m_);
    const double share = std::sqrt(static_cast<double>(n) / most);
    svg += titled(counted(static_cast<std::int64_t>(n), "kick", "kicks"),
                  fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                              "fill-opacity=\"{:.2f}\"/>",
                              kind, x.px(left), y.px(low + cell_m_), width, height, 0.12 + 0.88 * share));
  }
  return svg;
}

OutcomeKind kind_of(const KickTimeline& timeline) {
  const std::string label = timeline.observed ? timeline.observed->outcome : "unknown";
  if (label == "on_target") return timeline.saved.value_or(false) ? OutcomeKind::kSaved : OutcomeKind::kInside;
  if (label == "post" || label == "bar") return OutcomeKind::kFrame;
  if (label == "blocked") return OutcomeKind::kBlocked;
  if (label == "unknown" || label.empty()) return OutcomeKind::kUnknown;
  return OutcomeKind::kBeside;
}

std::string outcome_mark(OutcomeKind kind, const ChartPoint& at, double size) {
  const std::string name = kOutcomeNames[static_cast<std::size_t>(kind)].key;
  switch (kind) {
    case OutcomeKind::kInside:
    case OutcomeKind::kUnknown:
      return svg_circle("mark " + name, at, size);
    case OutcomeKind::kSaved:
      return svg_rect("mark " + name, {at.x - 1.3 * size, at.y - 0.4 * size}, 2.6 * size, 0.8 * size);
    case OutcomeKind::kFrame:
      return svg_rect("mark " + name, {at.x - 0.9 * size, at.y - 0.9 * size}, 1.8 * size, 1.8 * size);
    case OutcomeKind::kBeside:
      return fmt::format(
          "<path class=\"mark {0}\" d=\"M{1:.1f} {2:.1f}l{3:.1f} {3:.1f}l-{3:.1f} {3:.1f}l-{3:.1f} -{3:.1f}z\"/>\n",
          name, at.x, at.y - 1.2 * size, 1.2 * size);
    case OutcomeKind::kBlocked:
      return fmt::format(
          "<path class=\"mark {0}\" d=\"M{1:.1f} {2:.1f}l{3:.1f} {3:.1f}m0 -{3:.1f}l-{3:.1f} {3:.1f}\"/>\n", name,
          at.x - size, at.y - size, 2.0 * size);
  }
  return "";
}

std::string outcome_legend(const OutcomeCounts& counts, double y) {
  constexpr double kSlot = 172.0;
  std::string svg;
  std::size_t place = 0;
  for (std::size_t i = 0; i < kOutcomeNames.size(); ++i) {
    if (static_cast<OutcomeKind>(i) == OutcomeKind::kSaved && counts[i] == 0) continue;
    const std::size_t row = place / 3, column = place % 3;
    ++place;
    const double x = 14.0 + kSlot * static_cast<double>(column), baseline = y + 22.0 * static_cast<double>(row);
    svg += outcome_mark(static_cast<OutcomeKind>(i), {x, baseline - 5.0}, 5.0);
    svg += svg_text(x + 12.0, baseline, "start", fmt::format("{}: {}", kOutcomeNames[i].words, counts[i]));
  }
  return svg;
}

std::string outcome_words(const KickTimeline& timeline) {
  if (!timeline.observed || timeline.observed->outcome.empty()) return "no outcome";
  if (timeline.observed->outcome == "on_target" && timeline.saved) return *timeline.saved ? "saved" : "goal";
  return words(timeline.observed->outcome);
}

std::string kick_words(const KickTimeline& timeline) {
  const std::string kind = timeline.kick_kind > 0 ? fmt::format(", kind {}", timeline.kick_kind + 1) : "";
  return fmt::format("kick {}:{}, {}{}, {:.1f} m, {}", timeline.robot_id, timeline.number, timeline.policy, kind,
                     timeline.distance_m, outcome_words(timeline));
}

}  // namespace trivela::evaluator::page
