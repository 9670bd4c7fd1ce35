#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/stats/counts/exact.hpp"
#include "evaluator/stats/counts/interval.hpp"
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

namespace {

std::string measure_of(const Headline& headline) {
  return headline.of_opportunities ? "shots on target an opportunity" : "efficiency (on target of kicks)";
}

std::string cause_of(Design design, const std::string& by) {
  constexpr std::array kCauses{"", "; the {} took turns within the matches",
                               ", because of the {}: it was drawn at random",
                               ", because of the {}: both had the same opportunities"};
  static_assert(kCauses.size() == static_cast<std::size_t>(Design::kPaired) + 1);
  return fmt::format(fmt::runtime(kCauses.at(static_cast<std::size_t>(design))), by);
}

}  // namespace

std::string verdict_sentence(const PairResult& pair, const PolicyComparison& comparison) {
  if (!pair.headline) return pair.why_none + ".";
  const Headline& h = *pair.headline;
  const std::string numbers = fmt::format("{}, 95 % {}", points(h.difference), points(h.ci));
  const std::string measure =
      measure_of(h) + (h.adjusted ? ", on the same mix of " + comparison.dataset.stratified_by : "");
  const std::string smallest = fmt::format("{:.1f} points", 100.0 * comparison.smallest_effect);
  const bool causal = pair.design != Design::kBeforeAfter;
  const std::string cause = cause_of(pair.design, comparison.by);
  const std::string& a = pair.older;
  const std::string& b = pair.newer;
  switch (h.verdict) {
    case stats::Verdict::kBetter:
    case stats::Verdict::kBetterMaybeTooSmall: {
      const std::string small = h.verdict == stats::Verdict::kBetter
                                    ? ""
                                    : fmt::format(" Whether it is as much as {} cannot be said.", smallest);
      if (!causal)
        return fmt::format("{} differs from {} in {}: {}, the more for {}.{}", b, a, measure, numbers, b, small);
      return fmt::format("{} is better than {} in {}: {}{}.{}", b, a, measure, numbers, cause, small);
    }
    case stats::Verdict::kWorse:
      if (!causal) return fmt::format("{} differs from {} in {}: {}, the less for {}.", b, a, measure, numbers, b);
      return fmt::format("{} is worse than {} in {}: {}{}.", b, a, measure, numbers, cause);
    case stats::Verdict::kEquivalent:
      return fmt::format("{} and {} are alike in {} within {}: {}.{}", b, a, measure, smallest, numbers,
                         h.ci.lo > 0.0   ? " The difference is clear of zero, though too small to matter."
                         : h.ci.hi < 0.0 ? " The difference is clear of zero, though too small to matter."
                                         : "");
    case stats::Verdict::kNotEnoughData:
      return fmt::format("There is not enough data to tell {} from {} in {}: {}.", b, a, measure, numbers);
  }
  return "";
}

std::string design_sentence(const PairResult& pair, const PolicyComparison& comparison) {
  std::string reason = comparison.dataset.design_reason;
  if (pair.design != comparison.dataset.design) reason = "no opportunity that both had";
  const std::string because = reason.empty() ? "" : " (" + reason + ")";
  switch (pair.design) {
    case Design::kBeforeAfter:
      return fmt::format(
          "before and after{}: whatever else differed between these matches, opponents, floors, calibration, differs "
          "with the {}; the numbers say that they differ and not why",
          because, comparison.by);
    case Design::kAlternating:
      return fmt::format("alternating{}: both met the same opponents and floors, the order in a match may still matter",
                         because);
    case Design::kRandomised:
      return fmt::format("randomised{}: chance alone decided which possession was whose", because);
    case Design::kPaired:
      return fmt::format(
          "paired{}: the same simulated opportunities for both, so that the difference is theirs, in this scenario",
          because);
  }
  return "";
}

std::string needed_sentence(const PairResult& pair, const PolicyComparison& comparison) {
  if (!pair.headline) return "";
  const Headline& h = *pair.headline;
  if (h.verdict != stats::Verdict::kNotEnoughData && h.verdict != stats::Verdict::kBetterMaybeTooSmall) return "";
  const Effect& effect = h.of_opportunities ? *pair.per_opportunity : *pair.efficiency;
  const char* const what = h.of_opportunities ? "opportunities" : "kicks";
  const auto more = [&](double needed) {
    const double least = static_cast<double>(std::min(effect.older.n, effect.newer.n));
    const double missing = std::ceil(needed - least);
    return missing > 0.0 ? fmt::format("about {:.0f} more {} of the one that has fewer ({:.0f} of each)", missing, what,
                                       std::ceil(needed))
                         : fmt::format("no more {} ({:.0f} of each)", what, std::ceil(needed));
  };
  std::string text = fmt::format("To find a difference of {:.1f} points with 80 % power: {}",
                                 100.0 * comparison.smallest_effect, more(h.needed_for_smallest));
  if (h.needed_for_seen && std::abs(h.difference) > comparison.smallest_effect) {
    text += fmt::format("; if the {} points seen are the true ones: {}", fmt::format("{:+.1f}", 100.0 * h.difference),
                        more(*h.needed_for_seen));
  }
  return text + ".";
}

}  // namespace trivela::evaluator
