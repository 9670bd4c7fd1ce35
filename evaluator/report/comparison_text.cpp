#include <fmt/format.h>

#include "evaluator/report/comparison.hpp"
#include "evaluator/report/text_table.hpp"

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

std::string p_value(double p) { return p > 0.0 ? fmt::format("{:.3g}", p) : "below 1e-280"; }

// Breaks at blanks before 110 columns; further lines are indented.
std::string wrapped(const std::string& sentence) {
  constexpr std::size_t kWidth = 110;
  std::string text;
  std::size_t start = 0;
  while (sentence.size() - start > kWidth) {
    const std::size_t blank = sentence.rfind(' ', start + kWidth);
    text += sentence.substr(start, blank - start) + "\n    ";
    start = blank + 1;
  }
  return text + sentence.substr(start);
}

}  // namespace

std::string to_text(const Comparison& c) {
  std::string text =
      text_table({{"", "inside", "outside", "efficiency", "Wilson 95 %"}, row(c.older), row(c.newer)}) + "\n";
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<22}{}\n", what, value);
  };
  line("difference", fmt::format("{:+.1f} percentage points, 95 % {:+.1f} to {:+.1f} (Newcombe)", 100.0 * c.difference,
                                 100.0 * c.newcombe95.lo, 100.0 * c.newcombe95.hi));
  std::string gain = c.relative_gain ? fmt::format("{:+.1f} % from the counts", 100.0 * *c.relative_gain)
                                     : std::string("-, since nothing was inside before");
  if (c.is_table2()) gain += " (the paper's 46 % is 76/52 of its rounded values)";
  line("relative gain", gain);
  line("risk ratio", ratio(c.risk_ratio, "Katz"));
  line("odds ratio", ratio(c.odds_ratio, "Woolf"));
  line("Fisher p", fmt::format("{} two-sided (sum of the probabilities not above the table's), {} one-sided",
                               p_value(c.fisher_two_sided_p), p_value(c.fisher_one_sided_p)));
  line("Boschloo p", c.boschloo_one_sided_p && c.boschloo_two_sided_p
                         ? fmt::format("{} two-sided (twice the smaller one-sided p), {} one-sided",
                                       p_value(*c.boschloo_two_sided_p), p_value(*c.boschloo_one_sided_p))
                         : "-, too many kicks for this test");
  line("P(new better)", fmt::format("{:.6f} (uniform priors)", c.p_new_better));
  text += "\nTo be read with care\n";
  for (const std::string& note : notes(c)) text += "  - " + wrapped(note) + "\n";
  return text;
}

}  // namespace trivela::evaluator
