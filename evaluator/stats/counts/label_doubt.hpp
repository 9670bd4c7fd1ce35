#pragma once

#include <cstdint>

#include "evaluator/stats/counts/counts.hpp"
#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {

/// Labels that are expected to be wrong, by the doubt of whoever gave them: sums of probabilities.
struct LabelDoubt {
  double inside = 0.0;   ///< over the kicks called inside: that they were not
  double outside = 0.0;  ///< over the kicks called outside: that they were inside

  double sum() const { return inside + outside; }
  LabelDoubt& operator+=(const LabelDoubt& other) {
    inside += other.inside;
    outside += other.outside;
    return *this;
  }
};

/// Kicks of one group with all that is not known of them.
struct DoubtfulCounts {
  Counts known;              ///< inside of the labelled ones
  std::int64_t unknown = 0;  ///< without a label
  LabelDoubt doubt{};        ///< of the labels
};

/// As many labels as may be wrong where `expected` are: the least k with P(Poisson(expected) <= k) >= 0.975. Errors
/// that come apart spread less than Poisson's (Hoeffding 1956), so that it holds for any such probabilities.
std::int64_t most_wrong(double expected);

/// Efficiency if every unknown kick was outside and as many inside labels as may be are wrong, and the reverse. No
/// kick: [0, 1].
Interval efficiency_bounds(const DoubtfulCounts& counts);

/// The same of the difference newer - older: the one at its least and the other at its most, and the reverse. A group
/// without kicks: [-1, 1].
Interval difference_bounds(const DoubtfulCounts& older, const DoubtfulCounts& newer);

}  // namespace trivela::evaluator::stats
