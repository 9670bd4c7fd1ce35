#pragma once

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {

// Intervals and tests that hold at every look at once: whoever looks after each kick and stops when they like what they
// sees errs no more often than 1 - confidence (Ville 1939; Robbins 1970, "Statistical methods related to the law of the
// iterated logarithm"; of two groups Turner, Ly and Gruenwald 2024). They pay for it by being wider than Wilson's.

/// Proportions that `counts` do not speak against. With a uniform prior the ratio
/// M(p) = int_0^1 x^k (1 - x)^(n-k) dx / (p^k (1 - p)^(n-k)) is a martingale with mean 1 where p is true, and exceeds
/// 1 / (1 - confidence) at any time with a probability of 1 - confidence at most. The interval is where it is below,
/// which is where the binomial probability of k of n exceeds (1 - confidence) / (n + 1). No kick: [0, 1].
Interval confidence_sequence(Counts counts, double confidence = kConfidence);

/// Logarithm of the evidence against p_new - p_old = difference, in [-1, 1]: the least of M_old(p) M_new(p +
/// difference) over p. It exceeds log(1 / a) at any time with a probability of a at most where the difference is true,
/// however the next kick's group is chosen. Infinite: the difference cannot be.
double log_evidence_against(double difference, Counts older, Counts newer);

/// Differences newer - older whose evidence stays below 1 / (1 - confidence). No kick in either group: [-1, 1].
Interval difference_sequence(Counts older, Counts newer, double confidence = kConfidence);

/// min(1, exp(-evidence against no difference)): under `a` at any time with a probability of a at most where there is
/// none.
double always_valid_p(Counts older, Counts newer);

}  // namespace trivela::evaluator::stats
