#pragma once

#include <cstdint>
#include <optional>

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {

/// Fisher's exact test that the newer group is better: P(K2 >= k2) with both margins fixed (hypergeometric).
/// 1 where a group has no kicks.
double fisher_one_sided(Counts older, Counts newer);

/// Fisher's exact test, two-sided as the sum of the probabilities not above that of the table seen (R's fisher.test).
double fisher_two_sided(Counts older, Counts newer);

/// Most kicks of both groups that Boschloo's test works through.
inline constexpr std::int64_t kBoschlooKicks = 10'000;

/// Boschloo's exact test that the newer group is better (Boschloo 1970): Fisher's one-sided p is the statistic, and
/// the p value is the supremum over the common proportion of the probability of a statistic not above the one seen.
/// None: more than kBoschlooKicks kicks.
std::optional<double> boschloo_one_sided(Counts older, Counts newer);

/// Twice the smaller of the two one-sided p values, at most 1: one of several definitions of two-sided (scipy's).
std::optional<double> boschloo_two_sided_doubled(Counts older, Counts newer);

/// Exact binomial test of the proportion p, 0 < p < 1, two-sided as the sum of the probabilities not above that of the
/// count seen (R's binom.test). 1 without trials.
double binomial_two_sided(Counts counts, double p);

/// Exact interval of a proportion (Clopper and Pearson 1934). Without trials [0, 1].
Interval clopper_pearson(Counts counts, double confidence = kConfidence);

/// Outcomes of one policy that would have to be labelled the other way before Fisher's two-sided p reaches alpha.
struct Fragility {
  std::int64_t newer = 0;  ///< of the newer policy, towards the older one's efficiency
  std::int64_t older = 0;  ///< of the older policy, towards the newer one's
};

/// None: p is alpha or above already.
std::optional<Fragility> fragility(Counts older, Counts newer, double alpha = 0.05);

/// E-value of a risk ratio (VanderWeele and Ding 2017): rr + sqrt(rr (rr - 1)), of 1 / rr below 1. As strong an
/// association, with the policy and with the outcome, would an unrecorded difference between the matches need to
/// explain the ratio away. 1 for a ratio of 1.
double e_value(double risk_ratio);

}  // namespace trivela::evaluator::stats
