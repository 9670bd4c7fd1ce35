#include "evaluator/page/figures/outcome_kind.hpp"

#include <fmt/format.h>

#include "evaluator/page/figures/figure.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::evaluator::page {

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
