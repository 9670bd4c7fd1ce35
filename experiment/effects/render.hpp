#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>

#include "evaluator/report/json_values.hpp"
#include "experiment/effects/effects.hpp"

namespace trivela::experiment {

/// "87.8 (87.1 to 88.5)" by `number`; "87.8 (-)" without an interval, "-" without a value.
inline std::string effect_text(const Effect& effect, const std::function<std::string(double)>& number) {
  if (!std::isfinite(effect.value)) return "-";
  return fmt::format("{} ({})", number(effect.value),
                     has_interval(effect) ? fmt::format("{} to {}", number(effect.ci.lo), number(effect.ci.hi)) : "-");
}

/// A share in per cent.
inline std::string share_text(const Effect& effect) {
  return effect_text(effect, [](double share) { return fmt::format("{:.1f}", 100.0 * share); });
}

/// A difference of shares in points of a hundred, the sign always there.
inline std::string points_text(const Effect& effect) {
  return effect_text(effect, [](double difference) { return fmt::format("{:+.1f}", 100.0 * difference); });
}

/// A number as a cell of CSV, empty where there is none.
inline std::string csv_cell(double number) { return std::isfinite(number) ? fmt::format("{:.6f}", number) : ""; }

/// Value and both ends of the interval.
inline std::string csv_cells(const Effect& effect) {
  return fmt::format("{},{},{}", csv_cell(effect.value), csv_cell(effect.ci.lo), csv_cell(effect.ci.hi));
}

/// {"value": ..., "ci": [lo, hi]}; null without a value, "ci" null without an interval.
inline evaluator::Json json_of(const Effect& effect) {
  if (!std::isfinite(effect.value)) return nullptr;
  return {{"value", effect.value}, {"ci", has_interval(effect) ? evaluator::json_of(effect.ci) : evaluator::Json()}};
}

/// What an experiment's 95 % intervals allow for. `evenings` of calibration; 0: robot files.
inline std::string interval_words(std::size_t evenings) {
  if (evenings == 0) return "95 % intervals by match, for these robot files alone (--calibrations)";
  return fmt::format("95 % intervals by match and by {} evenings of calibration", evenings);
}

}  // namespace trivela::experiment
