#pragma once

#include "evaluator/stats/counts.hpp"
#include "evaluator/stats/quantile.hpp"

namespace trivela::evaluator::stats {

/// Exact binomial test of the proportion p, 0 < p < 1, two-sided as the sum of the probabilities not above that of the
/// count seen (R's binom.test). 1 without trials.
double binomial_two_sided(Counts counts, double p);

/// Exact interval of a proportion (Clopper and Pearson 1934). Without trials [0, 1].
Interval clopper_pearson(Counts counts, double confidence = kConfidence);

}  // namespace trivela::evaluator::stats
