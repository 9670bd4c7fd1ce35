#pragma once

#include <string>
#include <string_view>

namespace trivela::hal::scip {

/// What the status of a reply to `request` means, as a clause: "the end step is out of range". Of an unknown one its
/// two characters. Source: Hokuyo, C-42-03320B, sections 8 and 9.
std::string meaning(std::string_view request, std::string_view status);

}  // namespace trivela::hal::scip
