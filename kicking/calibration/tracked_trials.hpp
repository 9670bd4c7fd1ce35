#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kicking/calibration/table_fit.hpp"

namespace trivela::kicking {

/// A kick of a standing robot that a camera followed.
struct TrackedTrial {
  double power = 0.0;
  double up_mps = 0.0;            ///< vertical velocity at the launch, by the camera's track
  std::optional<Trial> lob = {};  ///< of the same kick, by the laser
};

/// Trials of all kicks, those that the laser lost included: the effective exit speed is V = up (a + b up^2), a and b by
/// least squares over the kicks that both saw (drag takes more from a faster ball). The angle is the laser's; NaN where
/// it lost the kick. A set-point's mean then rests on all its kicks: where the laser keeps one in four, its standard
/// error is half as large. @throws std::invalid_argument for fewer than three kicks that both saw.
std::vector<Trial> tracked_trials(std::span<const TrackedTrial> kicks);

}  // namespace trivela::kicking
