#pragma once

#include "evaluator/report/policy_comparison.hpp"

namespace trivela::evaluator {

/// What the verdict on a pair rests on: shots on target an opportunity where opportunities are known, else efficiency;
/// within strata where that measure has them and the pair is not one of same opportunities; by match where there are
/// enough. `smallest_effect` is a proportion. p is not adjusted for other pairs.
Headline headline_of(const PairResult& pair, double smallest_effect);

}  // namespace trivela::evaluator
