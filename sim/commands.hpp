#pragma once

#include <cstdint>
#include <optional>

#include "kicking/geometry/frames.hpp"

namespace trivela::sim {

/// Energise the coil.
struct Fire {
  std::int64_t t_ns = 0;  ///< instant; at once if it has passed
  std::int64_t kick_id = 0;
  double power = 0.0;  ///< set-point of the table for which the lever stands, clamped to its ends
};

/// What the robot asks of its devices in one cycle.
struct Commands {
  kicking::Twist drive{};       ///< velocity in R
  std::uint8_t lever_kind = 0;  ///< kind of kick for which the lever shall stand: 0 lob, 1 flat
  std::optional<Fire> fire;
};

}  // namespace trivela::sim
