#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {

/// Events such as shots on target, and the time that they came in.
struct Rate {
  std::int64_t events = 0;
  double minutes = 0.0;  ///< > 0
};

/// Of events a minute, exact (Garwood 1936): half the quantiles of chi-square with 2 k and 2 k + 2 degrees of freedom,
/// by the minutes. Throws std::invalid_argument where minutes are not above 0.
Interval rate_interval(Rate rate, double confidence = kConfidence);

/// Ratio of two rates, exact given the sum of the events (R's poisson.test, after Przyborowski and Wilenski 1940): the
/// newer one's share of them is binomial with r T2 / (T1 + r T2). The interval is Clopper and Pearson's of the share.
struct RateRatio {
  double value = 1.0;     ///< newer / older; infinite where the older one has no event
  Interval ci;            ///< the upper end may be infinite
  double p = 1.0;         ///< two-sided that the rates are equal
  bool by_match = false;  ///< from matches, not from Poisson's distribution
};

/// None: neither has an event.
std::optional<RateRatio> rate_ratio(Rate older, Rate newer, double confidence = kConfidence);

/// Events and time of both in one match.
struct MatchRates {
  std::uint32_t match = 0;
  Rate older;  ///< minutes 0: it did not play there
  Rate newer;
};

/// The same ratio with an interval of its logarithm by bias-reduced linearisation over matches (bias_reduced()): of the
/// ratio's halves in one match what they have in common cancels, and events that are more regular than Poisson's, such
/// as at most one kick an opportunity, or more alike within a match, count as they are.
/// Few matches can be alike by chance. With fewer than kManyMatches on a side, or without any spread, the interval is
/// no narrower than that of independent events, whose variance is 1 / older + 1 / newer.
/// None: one has no event, or plays in fewer than kFewestMatches.
std::optional<RateRatio> clustered_rate_ratio(std::span<const MatchRates> matches, double confidence = kConfidence);

}  // namespace trivela::evaluator::stats
