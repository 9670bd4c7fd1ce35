#pragma once

#include "evaluator/stats/counts/counts.hpp"

namespace trivela::evaluator::stats {

inline constexpr double kSmallestEffect = 0.05;  ///< smallest difference of interest, where nobody names another

/// What an interval of newer - older says against 0 and the smallest effect of interest.
enum class Verdict {
  kBetter,               ///< all of it above the smallest effect
  kBetterMaybeTooSmall,  ///< above 0, but perhaps below the smallest effect
  kEquivalent,           ///< within the smallest effect on either side, whether or not it holds 0
  kWorse,                ///< below 0, and perhaps by more than the smallest effect
  kNotEnoughData,        ///< it holds 0 and differences of interest
};

inline Verdict verdict(Interval interval, double smallest_effect = kSmallestEffect) {
  if (interval.lo > -smallest_effect && interval.hi < smallest_effect) return Verdict::kEquivalent;
  if (interval.lo > smallest_effect) return Verdict::kBetter;
  if (interval.lo > 0.0) return Verdict::kBetterMaybeTooSmall;
  if (interval.hi < 0.0) return Verdict::kWorse;
  return Verdict::kNotEnoughData;
}

}  // namespace trivela::evaluator::stats
