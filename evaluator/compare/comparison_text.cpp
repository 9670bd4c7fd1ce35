#include <fmt/format.h>

#include <cmath>

#include "evaluator/compare/comparison.hpp"
#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::evaluator {
namespace {

std::vector<std::string> row(const NamedCounts& group) {
  const auto& counts = group.counts;
  const auto wilson = stats::wilson(counts);
  return {group.name, std::to_string(counts.inside), std::to_string(counts.n - counts.inside),
          percent(*stats::efficiency(counts)), fmt::format("{} to {}", percent(wilson.lo), percent(wilson.hi))};
}

std::string ratio(const std::optional<stats::Ratio>& ratio, const char* method) {
  if (!ratio) return "-, since a count is zero";
  return fmt::format("{:.3f}, 95 % {:.3f} to {:.3f} ({})", ratio->value, ratio->ci.lo, ratio->ci.hi, method);
}

std::string tiny(double x) { return x < 1e-12 ? "below 1e-12" : fmt::format("{:.2g}", x); }

// Counts do not say how the two came about: they may differ for any reason.
std::string verdict_of(const Comparison& c) {
  const std::string smallest = fmt::format("{:.1f} points", 100.0 * c.smallest_effect);
  const std::string differs = fmt::format("{} differs from {}, the ", c.newer.name, c.older.name);
  switch (c.verdict) {
    case stats::Verdict::kBetter:
      return differs + "more for " + c.newer.name;
    case stats::Verdict::kBetterMaybeTooSmall:
      return differs + fmt::format("more for {}, perhaps by less than {}", c.newer.name, smallest);
    case stats::Verdict::kWorse:
      return differs + "less for " + c.newer.name;
    case stats::Verdict::kEquivalent:
      return fmt::format("{} and {} are alike within {}", c.newer.name, c.older.name, smallest);
    case stats::Verdict::kNotEnoughData:
      break;
  }
  return fmt::format("not enough data to tell {} from {}", c.newer.name, c.older.name);
}

std::string kicks_of_each(double kicks) { return fmt::format("{:.0f} kicks of each", std::ceil(kicks)); }

}  // namespace

std::string p_value(double p) { return p > 1e-280 ? fmt::format("{:.3g}", p) : "below 1e-280"; }

std::string points(double difference) { return fmt::format("{:+.1f} percentage points", 100.0 * difference); }

std::string points(stats::Interval interval) {
  return fmt::format("{:+.1f} to {:+.1f}", 100.0 * interval.lo, 100.0 * interval.hi);
}

std::string wrapped(const std::string& sentence, const std::string& indent, std::size_t width) {
  std::string text;
  std::size_t start = 0;
  while (sentence.size() - start > width) {
    std::size_t blank = sentence.rfind(' ', start + width);
    if (blank == std::string::npos || blank <= start) blank = sentence.find(' ', start + width);
    if (blank == std::string::npos) break;
    text += sentence.substr(start, blank - start) + "\n" + indent;
    start = blank + 1;
  }
  return text + sentence.substr(start);
}

std::string bullet(const std::string& sentence) { return "  - " + wrapped(sentence, "    ") + "\n"; }

std::string named_line(const std::string& name, const std::string& value) {
  return fmt::format("  {:<22}{}{}\n", name, name.size() < 22 ? "" : " ", value);
}

std::string efficiency_lines(const Comparison& c) {
  std::string text =
      named_line("difference", fmt::format("{}, 95 % {} (Newcombe)", points(c.difference), points(c.newcombe95)));
  if (c.agresti_caffo95)
    text += named_line("", fmt::format("95 % {} (Agresti and Caffo, for few kicks)", points(*c.agresti_caffo95)));
  std::string gain = c.relative_gain ? fmt::format("{:+.1f} % from the counts", 100.0 * *c.relative_gain)
                                     : std::string("-, since nothing was inside before");
  if (c.is_table2()) gain += " (the paper's 46 % is 76/52 of its rounded values)";
  text += named_line("relative gain", gain);
  text += named_line("risk ratio", ratio(c.risk_ratio, "Katz"));
  text += named_line("odds ratio", ratio(c.odds_ratio, "Woolf"));
  text +=
      named_line("Fisher p", fmt::format("{} two-sided (sum of the probabilities not above the table's), {} one-sided",
                                         p_value(c.fisher_two_sided_p), p_value(c.fisher_one_sided_p)));
  text += named_line("Boschloo p", c.boschloo_one_sided_p && c.boschloo_two_sided_p
                                       ? fmt::format("{} two-sided (twice the smaller one-sided p), {} one-sided",
                                                     p_value(*c.boschloo_two_sided_p), p_value(*c.boschloo_one_sided_p))
                                       : "-, too many kicks for this test");
  text += named_line(fmt::format("P({} > {})", c.newer.name, c.older.name),
                     fmt::format("{:.6f} (uniform priors)", c.p_new_better));
  text += named_line(
      "posterior difference",
      fmt::format("median {:+.1f}, 95 % {} percentage points; P(above {:.1f}) {:.4f}", 100.0 * c.posterior.median,
                  points(c.posterior.central), 100.0 * c.smallest_effect, c.p_gain_above_smallest));
  text += named_line("expected loss", fmt::format("{} percentage points by choosing {}",
                                                  tiny(100.0 * c.expected_loss_of_newer), c.newer.name));
  text +=
      named_line("fragility",
                 c.fragility ? fmt::format("{} outcomes of {} or {} of {} labelled the other way make Fisher's p 0.05",
                                           c.fragility->newer, c.newer.name, c.fragility->older, c.older.name)
                             : "-, Fisher's p is above 0.05 already");
  return text;
}

std::string to_text(const Comparison& c) {
  std::string size = kicks_of_each(c.needed_for_smallest) +
                     fmt::format(" to see {:.1f} points with 80 % power", 100.0 * c.smallest_effect);
  if (c.needed_for_seen) size += fmt::format(", {} for the difference seen", kicks_of_each(*c.needed_for_seen));
  std::string text = text_table({{"", "inside", "outside", "efficiency", "Wilson 95 %"}, row(c.older), row(c.newer)}) +
                     "\n" + efficiency_lines(c) + named_line("kicks needed", size) +
                     named_line("verdict", verdict_of(c));
  text += "\nTo be read with care\n";
  for (const std::string& note : notes(c)) text += bullet(note);
  return text + gates_text(c.gates);
}

}  // namespace trivela::evaluator
