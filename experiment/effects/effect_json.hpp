#pragma once

#include <cmath>

#include "evaluator/report/json_values.hpp"
#include "experiment/effects/effects.hpp"

namespace trivela::experiment {

/// {"value": ..., "ci": [lo, hi]}; null without a value, "ci" null without an interval.
inline evaluator::Json json_of(const Effect& effect) {
  if (!std::isfinite(effect.value)) return nullptr;
  return {{"value", effect.value}, {"ci", has_interval(effect) ? evaluator::json_of(effect.ci) : evaluator::Json()}};
}

}  // namespace trivela::experiment
