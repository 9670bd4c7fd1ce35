#pragma once

#include <cmath>

#include "cli/factorial/effects.hpp"
#include "evaluator/report/json_values.hpp"

namespace trivela::cli {

/// {"value": ..., "ci": [lo, hi]}; null without a value, "ci" null without an interval.
inline evaluator::Json json_of(const Effect& effect) {
  if (!std::isfinite(effect.value)) return nullptr;
  return {{"value", effect.value}, {"ci", has_interval(effect) ? evaluator::json_of(effect.ci) : evaluator::Json()}};
}

}  // namespace trivela::cli
