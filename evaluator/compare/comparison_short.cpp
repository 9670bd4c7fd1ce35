#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/stats/test_plan.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::evaluator {
namespace {

constexpr std::size_t kMostDifferences = 10;
constexpr std::size_t kMostRemarks = 3;

std::string who_is_better(const PairResult& pair, double smallest_effect) {
  const bool causal = pair.design != Design::kBeforeAfter;  // the design says whose the difference is
  switch (pair.headline->verdict) {
    case stats::Verdict::kBetter:
    case stats::Verdict::kBetterMaybeTooSmall:
      return fmt::format("{} {} {}", pair.newer, causal ? "is better than" : "differs from", pair.older);
    case stats::Verdict::kWorse:
      return fmt::format("{} {} {}", pair.newer, causal ? "is worse than" : "differs from", pair.older);
    case stats::Verdict::kEquivalent:
      return fmt::format("{} and {} are alike within {:.1f} points", pair.newer, pair.older, 100.0 * smallest_effect);
    case stats::Verdict::kNotEnoughData:
      break;
  }
  return fmt::format("{} against {}, not enough data", pair.newer, pair.older);
}

std::string more_needed(const PairResult& pair, double smallest_effect) {
  const Headline& h = *pair.headline;
  const Effect& effect = h.of_opportunities ? *pair.per_opportunity : *pair.efficiency;
  const char* const unit = h.of_opportunities ? "opportunities" : "kicks";
  const bool open = h.verdict == stats::Verdict::kNotEnoughData || h.verdict == stats::Verdict::kBetterMaybeTooSmall;
  const double more = std::ceil(h.needed_for_smallest - static_cast<double>(std::min(effect.older.n, effect.newer.n)));
  if (!open || more <= 0.0) return fmt::format("no more {} needed", unit);
  return fmt::format("about {:.0f} more {} of the one with fewer for {:.1f} points", more, unit,
                     100.0 * smallest_effect);
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
  return fmt::format("{}: {:+.1f} points {}{}, 95 % {}, p {}{}; {}\n", who_is_better(pair, c.smallest_effect),
                     100.0 * h.difference, h.of_opportunities ? "in shots on target an opportunity" : "in efficiency",
                     h.adjusted ? " on the same mix of " + c.dataset.stratified_by : "", points(h.ci),
                     p_value(h.p_holm), comparisons > 1 ? fmt::format(" (Holm, {} comparisons)", comparisons) : "",
                     more_needed(pair, c.smallest_effect));
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
  PairResult pair;
  std::tie(pair.older, pair.newer) = std::tie(c.older.name, c.newer.name);
  Effect& efficiency = pair.efficiency.emplace();
  std::tie(efficiency.older, efficiency.newer) = std::tie(c.older.counts, c.newer.counts);
  Headline& headline = pair.headline.emplace();
  headline.difference = c.difference;
  headline.ci = c.newcombe95;
  headline.p_holm = c.boschloo_two_sided_p.value_or(c.fisher_two_sided_p);
  headline.verdict = c.verdict;
  headline.needed_for_smallest = c.needed_for_smallest;
  PolicyComparison alone;
  alone.smallest_effect = c.smallest_effect;
  return short_line_of(pair, alone, 1) +
         "  by the counts alone, kicks taken as independent; every test and what to be careful about: --all\n" +
         gates_text(c.gates);
}

}  // namespace trivela::evaluator
