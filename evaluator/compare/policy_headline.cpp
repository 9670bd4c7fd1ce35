#include "evaluator/compare/policy_comparison.hpp"

#include <algorithm>

#include "evaluator/stats/counts/counts.hpp"
#include "evaluator/stats/counts/exact.hpp"
#include "evaluator/stats/test_plan.hpp"

namespace trivela::evaluator {
namespace {

double p_of(const stats::Clustered& clustered) {
  if (clustered.standard_error == 0.0) return clustered.value == 0.0 ? 1.0 : 0.0;
  return stats::student_p(clustered.value / clustered.standard_error, clustered.df);
}

/// The ratio of the variance seen to that of independent kicks: of standard errors, or of intervals of one kind. 1
/// where nothing is clustered, paired or standardised.
double variance_ratio(const Effect& effect, const std::optional<stats::Clustered>& clustered, stats::Interval ci) {
  if (!clustered) {
    const auto independent = stats::newcombe_or_exact(effect.older, effect.newer);
    return stats::square((ci.hi - ci.lo) / (independent.hi - independent.lo));
  }
  const double p1 = *stats::efficiency(effect.older), p2 = *stats::efficiency(effect.newer);
  const double independent =
      p1 * (1.0 - p1) / static_cast<double>(effect.older.n) + p2 * (1.0 - p2) / static_cast<double>(effect.newer.n);
  const bool known = independent > 0.0 && clustered->standard_error > 0.0;
  return known ? stats::square(clustered->standard_error) / independent : 1.0;
}

// Kicks of each policy for a difference of this size.
std::optional<double> needed(const Effect& effect, double variance_ratio, double difference) {
  const double p1 = *stats::efficiency(effect.older);
  const double other = p1 + difference <= 1.0 && p1 + difference >= 0.0 ? p1 + difference : p1 - difference;
  const auto kicks = stats::kicks_per_policy(p1, std::clamp(other, 0.0, 1.0));
  if (!kicks) return std::nullopt;
  return *kicks * variance_ratio;
}

void rest_on_matches(Headline& result, const PairResult& pair, const stats::Clustered& clustered) {
  result.by_match = true;
  result.difference = clustered.value;
  result.ci = clustered.ci;
  result.p = p_of(clustered);
  result.method = pair.pairs        ? "paired, clustered by "
                  : result.adjusted ? "standardised, clustered by "
                                    : "clustered by ";
  result.method += clustered.by_calibration ? "match and calibration" : "match";
  result.p_method = "Student's t of the difference over matches";
  if (clustered.by_calibration) result.p_method += " and calibrations";
}

void rest_on_strata(Headline& result, const Stratified& stratified) {
  result.difference = stratified.standardised->difference.value;
  result.ci = stratified.standardised->difference.ci;
  result.p = stratified.cmh ? stratified.cmh->p : 1.0;
  result.method = "standardised, MOVER of Wilson intervals";
  result.p_method = "Cochran-Mantel-Haenszel";
}

void rest_on_counts(Headline& result, const PairResult& pair, const Effect& crude) {
  result.difference = crude.difference;
  result.ci = crude.independent;
  if (pair.pairs) {
    result.p = pair.mcnemar_p;
    result.method = "Newcombe's for pairs";
    result.p_method = "McNemar, exact";
  } else {
    const auto boschloo = stats::boschloo_two_sided_doubled(crude.older, crude.newer);
    result.p = boschloo ? *boschloo : stats::fisher_two_sided(crude.older, crude.newer);
    result.method = "Newcombe's";
    result.p_method = boschloo ? "Boschloo, twice the smaller one-sided p" : "Fisher";
  }
}

}  // namespace

Headline headline_of(const PairResult& pair, double smallest_effect) {
  Headline result;
  result.of_opportunities = pair.per_opportunity.has_value();
  const Effect& crude = result.of_opportunities ? *pair.per_opportunity : *pair.efficiency;
  result.adjusted = pair.stratified && pair.stratified->standardised && !pair.pairs &&
                    pair.stratified->of_opportunities == result.of_opportunities;
  const auto& clustered = result.adjusted ? pair.stratified->clustered : crude.clustered;
  if (clustered) {
    rest_on_matches(result, pair, *clustered);
  } else if (result.adjusted) {
    rest_on_strata(result, *pair.stratified);
  } else {
    rest_on_counts(result, pair, crude);
  }
  const double ratio = variance_ratio(crude, clustered, result.ci);
  result.p_holm = result.p;
  result.verdict = stats::verdict(result.ci, smallest_effect);
  result.needed_for_smallest = needed(crude, ratio, smallest_effect).value_or(0.0);
  result.needed_for_seen = needed(crude, ratio, result.difference);
  return result;
}

}  // namespace trivela::evaluator
