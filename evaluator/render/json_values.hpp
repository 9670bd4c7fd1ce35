#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator {

using Json = nlohmann::ordered_json;

/// For a terminal, too: everything but printable ASCII is escaped, and what is no UTF-8 replaced by U+FFFD.
template <typename AnyJson>
std::string json_text(const AnyJson& json) {
  return json.dump(2, ' ', true, AnyJson::error_handler_t::replace) + "\n";
}

/// The value, or null.
template <typename T>
Json json_of(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

/// A value for each of them, as `of` makes it.
template <class Rows, class Of>
Json json_list(const Rows& rows, const Of& of) {
  Json list = Json::array();
  for (const auto& row : rows) list.push_back(of(row));
  return list;
}

/// [lo, hi].
inline Json json_of(stats::Interval interval) { return Json::array({interval.lo, interval.hi}); }

}  // namespace trivela::evaluator
