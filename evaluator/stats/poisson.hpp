#pragma once

#include <cstdint>
#include <optional>

#include "evaluator/stats/counts.hpp"
#include "evaluator/stats/quantile.hpp"

namespace trivela::evaluator::stats {

/// Events such as shots on target, and the time that they came in.
struct Rate {
  std::int64_t events = 0;
  double minutes = 0.0;  ///< > 0
};

/// Ratio of two rates, exact given the sum of the events (R's poisson.test, after Przyborowski and Wilenski 1940): the
/// newer one's share of them is binomial with r T2 / (T1 + r T2). The interval is Clopper and Pearson's of the share.
struct RateRatio {
  double value = 1.0;  ///< newer / older; infinite where the older one has no event
  Interval ci;         ///< the upper end may be infinite
  double p = 1.0;      ///< two-sided that the rates are equal
};

/// None: neither has an event.
std::optional<RateRatio> rate_ratio(Rate older, Rate newer, double confidence = kConfidence);

}  // namespace trivela::evaluator::stats
