#include "cli/factorial/effects.hpp"

#include <cmath>

#include "evaluator/stats/quantile.hpp"

namespace trivela::cli {
namespace {

double real(std::int64_t n) { return static_cast<double>(n); }

/// t times the standard error of a sum of influences over matches.
double reach_of(const std::vector<double>& influences) {
  const auto groups = static_cast<double>(influences.size());
  if (groups < 2.0) return std::nan("");
  double squares = 0.0;
  for (const double u : influences) squares += u * u;
  return evaluator::stats::t_of(evaluator::stats::kConfidence, groups - 1.0) *
         std::sqrt(groups / (groups - 1.0) * squares);
}

}  // namespace

MatchTally total_of(const ArmTally& matches) {
  MatchTally total;
  for (const MatchTally& match : matches) {
    total.opportunities += match.opportunities;
    total.kicks += match.kicks;
    total.on_target += match.on_target;
  }
  return total;
}

evaluator::stats::Counts counts_of(const MatchTally& tally, Measure measure) {
  return {tally.on_target, measure == Measure::kEfficiency ? tally.kicks : tally.opportunities};
}

Effect contrast(std::span<const Term> terms, Measure measure) {
  Effect effect;
  std::vector<double> influences;
  for (const Term& term : terms) {
    const auto total = counts_of(total_of(*term.arm), measure);
    const double n = real(total.n), p = real(total.inside) / n;
    effect.value += term.weight * p;
    influences.resize(term.arm->size());
    for (std::size_t m = 0; m < term.arm->size(); ++m) {
      const auto match = counts_of((*term.arm)[m], measure);
      influences[m] += term.weight * (real(match.inside) - p * real(match.n)) / n;
    }
  }
  const double reach = reach_of(influences);
  effect.ci = {effect.value - reach, effect.value + reach};
  return effect;
}

Effect kick_ratio(const ArmTally& older, const ArmTally& newer) {
  const double n1 = real(total_of(older).kicks), n2 = real(total_of(newer).kicks);
  std::vector<double> influences(older.size());
  for (std::size_t m = 0; m < older.size(); ++m) {
    influences[m] = real(newer[m].kicks) / n2 - real(older[m].kicks) / n1;
  }
  const double reach = reach_of(influences);
  return {n2 / n1, {n2 / n1 * std::exp(-reach), n2 / n1 * std::exp(reach)}};
}

}  // namespace trivela::cli
