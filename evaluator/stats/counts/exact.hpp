#pragma once

#include <optional>

#include "evaluator/stats/counts/counts.hpp"
#include "evaluator/stats/counts/quantile.hpp"

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

}  // namespace trivela::evaluator::stats
