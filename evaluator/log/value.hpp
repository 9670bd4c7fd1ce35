#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace trivela::evaluator::log {

using Blob = std::vector<std::uint8_t>;

/// One cell of a row: nothing (NULL), an integer (booleans as 0 and 1), a number, a text (labels of enums), bytes.
using Value = std::variant<std::monostate, std::int64_t, double, std::string, Blob>;

/// The number in a cell; none where it is NULL or no number.
inline std::optional<double> number_if_any(const Value& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  return std::nullopt;
}

/// The same; NaN where there is none.
inline double number(const Value& cell) {
  return number_if_any(cell).value_or(std::numeric_limits<double>::quiet_NaN());
}

/// The whole number in a cell. Throws std::bad_variant_access where it is none.
inline std::int64_t integer(const Value& cell) { return std::get<std::int64_t>(cell); }

/// The same; none where it is NULL.
inline std::optional<std::int64_t> integer_if_any(const Value& cell) {
  const auto* const whole = std::get_if<std::int64_t>(&cell);
  return whole != nullptr ? std::optional(*whole) : std::nullopt;
}

/// The text in a cell; empty where there is none.
inline std::string text_if_any(const Value& cell) {
  const auto* const text = std::get_if<std::string>(&cell);
  return text != nullptr ? *text : std::string();
}

/// Called with the cells of one row, in the order of the columns asked for.
using RowFunction = std::function<void(std::span<const Value>)>;

}  // namespace trivela::evaluator::log
