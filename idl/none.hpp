#pragma once

#include <limits>

namespace trivela::msg {

/// What a message's number holds where there is none.
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace trivela::msg
