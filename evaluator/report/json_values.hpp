#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "evaluator/stats/counts.hpp"

namespace trivela::evaluator {

using Json = nlohmann::ordered_json;

/// The value, or null.
template <typename T>
Json json_of(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

/// [lo, hi].
inline Json json_of(stats::Interval interval) { return Json::array({interval.lo, interval.hi}); }

}  // namespace trivela::evaluator
