#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace trivela::log {

using Blob = std::vector<std::uint8_t>;

/// One cell of a row: nothing (NULL), an integer (booleans as 0 and 1), a number, a text (labels of enums), bytes.
using Value = std::variant<std::monostate, std::int64_t, double, std::string, Blob>;

/// Called once, before the first row, with the names of the columns.
using HeadFunction = std::function<void(const std::vector<std::string>&)>;

/// Called with the cells of one row, in the order of the columns asked for.
using RowFunction = std::function<void(std::span<const Value>)>;

/// The table of a match log for messages of a type, which is named like them or the plural of it: "vision_frames" for
/// "VisionFrame", "referee" for "Referee". None: they are not recorded.
std::optional<std::string> table_of_message(std::string_view type);

}  // namespace trivela::log
