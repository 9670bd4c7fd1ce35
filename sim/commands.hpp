#pragma once

#include <cstdint>
#include <optional>

#include "kicking/geometry/frames.hpp"

namespace trivela::sim {

/// Energise the coil.
struct Fire {
  std::int64_t t_ns = 0;  ///< instant; at once if it has passed
  std::int64_t kick_id = 0;
  double power = 0.0;  ///< set-point of the kicker's table, clamped to its ends
};

/// What the robot asks of its devices in one cycle.
struct Commands {
  kicking::Twist drive{};  ///< velocity in R
  std::optional<Fire> fire;
};

}  // namespace trivela::sim
