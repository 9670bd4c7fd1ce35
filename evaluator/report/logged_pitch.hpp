#pragma once

#include <string_view>

#include "kicking/geometry/goal.hpp"

namespace trivela::evaluator {

/// The field that a session was played on.
struct LoggedPitch {
  kicking::Goal goal{};
  double side_line_x_m = 6.0;
};

/// Out of [goal] and [field] of a session's configuration, as table `texts` has it; what it does not say stays as it is
/// by default.
LoggedPitch pitch_of(std::string_view config);

}  // namespace trivela::evaluator
