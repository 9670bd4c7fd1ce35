#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace trivela::evaluator::log {

/// One cell of a row: nothing (NULL), an integer (booleans as 0 and 1), a number, a text (labels of enums).
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;

}  // namespace trivela::evaluator::log
