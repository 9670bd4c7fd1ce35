#include "evaluator/stats/verdict.hpp"

namespace trivela::evaluator::stats {

Verdict verdict(Interval interval, double smallest_effect) {
  if (interval.lo > -smallest_effect && interval.hi < smallest_effect) return Verdict::kEquivalent;
  if (interval.lo > smallest_effect) return Verdict::kBetter;
  if (interval.lo > 0.0) return Verdict::kBetterMaybeTooSmall;
  if (interval.hi < 0.0) return Verdict::kWorse;
  return Verdict::kNotEnoughData;
}

}  // namespace trivela::evaluator::stats
