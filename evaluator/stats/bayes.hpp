#pragma once

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {

// Independent uniform priors throughout: the posteriors are Beta(k + 1, n - k + 1).

/// P(p_new - p_old > difference) = integral of f_new(p) F_old(p - difference) over [0, 1]. Without kicks in either
/// group 0.5 for a difference of 0.
double p_new_better(Counts older, Counts newer, double difference = 0.0);

/// Posterior of p_new - p_old.
struct PosteriorDifference {
  double median = 0.0;
  Interval central;  ///< as much of it on either side
};
PosteriorDifference posterior_difference(Counts older, Counts newer, double confidence = kConfidence);

/// What is lost on average by choosing the newer policy: E max(p_old - p_new, 0)
/// = E p_old P(Beta(a + 1, b) > p_new) - E p_new P(p_old > Beta(c + 1, d)), a, b of the older one's posterior, c, d of
/// the newer one's. 0 below 1e-14.
double expected_loss_of_newer(Counts older, Counts newer);

}  // namespace trivela::evaluator::stats
