#pragma once

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {

/// Opportunities that both policies had, by which of them had a shot on target.
struct PairedCounts {
  std::int64_t both = 0;
  std::int64_t newer_only = 0;
  std::int64_t older_only = 0;
  std::int64_t neither = 0;

  std::int64_t n() const { return both + newer_only + older_only + neither; }
  Counts older() const { return {both + older_only, n()}; }
  Counts newer() const { return {both + newer_only, n()}; }
};

/// McNemar's exact test, two-sided (McNemar 1947): of the opportunities on which the policies differ, half are
/// newer_only where neither is better. 1 where they never differ.
double mcnemar_two_sided(const PairedCounts& pairs);

/// Newcombe's hybrid score interval of p_new - p_old on the same opportunities (Newcombe 1998b, Statistics in Medicine
/// 17:2635, method 10). With both Wilson intervals and phi, the correlation of the 2x2 table with its numerator
/// brought n/2 nearer to zero where it is positive:
///   lo = d - sqrt((p2 - l2)^2 - 2 phi (p2 - l2)(u1 - p1) + (u1 - p1)^2), hi likewise. Without pairs [-1, 1].
Interval paired_newcombe(const PairedCounts& pairs, double confidence = kConfidence);

}  // namespace trivela::evaluator::stats
