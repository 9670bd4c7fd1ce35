#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trivela::evaluator::log {

/// The table of a match log for messages of a type, which is named like them or the plural of it: "vision_frames" for
/// "VisionFrame", "referee" for "Referee". None: they are not recorded.
std::optional<std::string> table_of_message(std::string_view type);

}  // namespace trivela::evaluator::log
