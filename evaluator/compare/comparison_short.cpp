#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/stats/test_plan.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::evaluator {
namespace {

constexpr std::size_t kMostDifferences = 10;
constexpr std::size_t kMostRemarks = 3;

/// Two groups and what is known of their difference.
struct ShortVerdict {
  std::string older;
  std::string newer;
  bool causal = false;  ///< the design says whose the difference is
  stats::Verdict verdict{};
  std::string measure;
  double difference = 0.0;
  stats::Interval ci;
  double p = 1.0;
  std::size_t comparisons = 1;  ///< that p is adjusted for
  double smallest_effect = 0.0;
  const char* unit = "kicks";
  double more = 0.0;  ///< of the group that has fewer, to see the smallest effect
};

std::string who_is_better(const ShortVerdict& v) {
  switch (v.verdict) {
    case stats::Verdict::kBetter:
    case stats::Verdict::kBetterMaybeTooSmall:
      return v.causal ? fmt::format("{} is better than {}", v.newer, v.older)
                      : fmt::format("{} differs from {}", v.newer, v.older);
    case stats::Verdict::kWorse:
      return v.causal ? fmt::format("{} is worse than {}", v.newer, v.older)
                      : fmt::format("{} differs from {}", v.newer, v.older);
    case stats::Verdict::kEquivalent:
      return fmt::format("{} and {} are alike within {:.1f} points", v.newer, v.older, 100.0 * v.smallest_effect);
    case stats::Verdict::kNotEnoughData:
      break;
  }
  return fmt::format("{} against {}, not enough data", v.newer, v.older);
}

std::string more_needed(const ShortVerdict& v) {
  const bool open = v.verdict == stats::Verdict::kNotEnoughData || v.verdict == stats::Verdict::kBetterMaybeTooSmall;
  const double more = std::ceil(v.more);
  if (!open || more <= 0.0) return fmt::format("no more {} needed", v.unit);
  return fmt::format("about {:.0f} more {} of the one with fewer for {:.1f} points", more, v.unit,
                     100.0 * v.smallest_effect);
}

// Who is better, by how much, how sure, how many more are needed.
std::string short_line(const ShortVerdict& v) {
  return fmt::format("{}: {:+.1f} points {}, 95 % {}, p {}{}; {}\n", who_is_better(v), 100.0 * v.difference, v.measure,
                     points(v.ci), p_value(v.p),
                     v.comparisons > 1 ? fmt::format(" (Holm, {} comparisons)", v.comparisons) : "", more_needed(v));
}

double missing(double needed_of_each, stats::Counts older, stats::Counts newer) {
  return needed_of_each - static_cast<double>(std::min(older.n, newer.n));
}

std::string goals_line(const PairResult& pair) {
  const Effect& goals = *pair.goals;
  const stats::Interval ci = goals.clustered ? goals.clustered->ci : goals.independent;
  return fmt::format("  goals: {} {} of {} opportunities, {} {} of {}; {:+.1f} points, 95 % {}\n", pair.newer,
                     goals.newer.inside, goals.newer.n, pair.older, goals.older.inside, goals.older.n,
                     100.0 * goals.difference, points(ci));
}

std::string remarks_of(const PolicyComparison& c) {
  std::string text;
  const auto& remarks = c.dataset.remarks;
  for (std::size_t i = 0; i < std::min(remarks.size(), kMostRemarks); ++i) text += bullet(remarks[i]);
  if (remarks.size() > kMostRemarks)
    text += fmt::format("  - and {} more remarks on the data (--all)\n", remarks.size() - kMostRemarks);
  if (c.sample_ratio_p && *c.sample_ratio_p < stats::kSampleRatioAlarm)
    text += bullet("The assignment did not go as planned: trust nothing above before that is explained (--all).");
  return text;
}

}  // namespace

std::string short_line_of(const PairResult& pair, const PolicyComparison& c, std::size_t comparisons) {
  if (!pair.headline) return fmt::format("{} against {}: {}\n", pair.newer, pair.older, pair.why_none);
  const Headline& h = *pair.headline;
  const Effect& effect = h.of_opportunities ? *pair.per_opportunity : *pair.efficiency;
  return short_line(
      {.older = pair.older,
       .newer = pair.newer,
       .causal = pair.design != Design::kBeforeAfter,
       .verdict = h.verdict,
       .measure = std::string(h.of_opportunities ? "in shots on target an opportunity" : "in efficiency") +
                  (h.adjusted ? " on the same mix of " + c.dataset.stratified_by : ""),
       .difference = h.difference,
       .ci = h.ci,
       .p = h.p_holm,
       .comparisons = comparisons,
       .smallest_effect = c.smallest_effect,
       .unit = h.of_opportunities ? "opportunities" : "kicks",
       .more = missing(h.needed_for_smallest, effect.older, effect.newer)});
}

std::string gates_text(std::span<const GateResult> gates) {
  std::string text = gates.empty() ? "" : "\nGates\n";
  for (const GateResult& gate : gates) text += fmt::format("  {}\n", kicking::printable(gate.sentence()));
  return text;
}

std::string head_text(const PolicyComparison& c, std::size_t most_differences) {
  std::string text = c.dataset.simulated ? kSimulated : "";
  if (c.logs.size() < 2) return text;
  text += differences_text(c.differences, c.logs, most_differences);
  text += between_logs_text(c.between);
  if (c.by != "log")
    text += "  Below, the sessions of all are taken together; --by log compares one log with another.\n";
  return text + "\n";
}

std::string to_short_text(const PolicyComparison& c) {
  std::string text = head_text(c, kMostDifferences);
  for (const PairResult& pair : c.pairs) {
    text += short_line_of(pair, c, c.pairs.size());
    if (pair.goals) text += goals_line(pair);
  }
  const Design design = c.pairs.front().design;
  text += fmt::format("  {}, outcomes {}; tables, tests and what to be careful about: --all\n",
                      design == Design::kBeforeAfter ? "before and after" : label(design),
                      c.dataset.outcome == "truth"      ? "by the simulator's truth"
                      : c.dataset.outcome == "labelled" ? "as labelled"
                      : c.dataset.outcome == "table"    ? "as the table says"
                                                        : "as observed");
  return text + remarks_of(c) + gates_text(c.gates);
}

std::string to_short_text(const Comparison& c) {
  const double p = c.boschloo_two_sided_p.value_or(c.fisher_two_sided_p);
  return short_line({.older = c.older.name,
                     .newer = c.newer.name,
                     .verdict = c.verdict,
                     .measure = "in efficiency",
                     .difference = c.difference,
                     .ci = c.newcombe95,
                     .p = p,
                     .smallest_effect = c.smallest_effect,
                     .more = missing(c.needed_for_smallest, c.older.counts, c.newer.counts)}) +
         "  by the counts alone, kicks taken as independent; every test and what to be careful about: --all\n" +
         gates_text(c.gates);
}

}  // namespace trivela::evaluator
