#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace trivela::evaluator::log {

using Blob = std::vector<std::uint8_t>;

/// One cell of a row: nothing (NULL), an integer (booleans as 0 and 1), a number, a text (labels of enums), bytes.
using Value = std::variant<std::monostate, std::int64_t, double, std::string, Blob>;

/// Called with the cells of one row, in the order of the columns asked for.
using RowFunction = std::function<void(std::span<const Value>)>;

}  // namespace trivela::evaluator::log
