#pragma once

#include "cli/factorial/effects.hpp"
#include "evaluator/report/json_values.hpp"

namespace trivela::cli {

/// {"value": ..., "ci": [lo, hi]}
inline evaluator::Json json_of(const Effect& effect) {
  return {{"value", effect.value}, {"ci", evaluator::json_of(effect.ci)}};
}

}  // namespace trivela::cli
