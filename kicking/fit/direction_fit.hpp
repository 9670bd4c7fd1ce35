#pragma once

#include <span>

#include "kicking/fit/least_squares.hpp"

namespace trivela::kicking {

/// Direction in which the ball of one kick of a standing robot left, over ground, with the standard error of the track
/// that it was read from [rad].
using LaunchDirection = Estimate;

/// How far the kicks of a standing robot scatter sideways.
struct DirectionFit {
  double mean_rad = 0.0;
  Estimate sd_rad{kNotKnown, kNotKnown};  ///< from kick to kick: sqrt(s^2 - mean(se^2)), s the scatter seen; unknown:
                                          ///< the tracks' own errors explain all of it
  double seen_sd_rad = 0.0;               ///< s, with n - 1
  double observer_sd_rad = 0.0;           ///< sqrt(mean(se^2))
};

/// The robot stands in one place in one direction for all kicks; how well it does so is part of the scatter.
/// se of the standard deviation: s^2 / (sd sqrt(2 (n - 1))), that of a normal sample.
/// Throws std::invalid_argument for fewer than two kicks or a value that is not finite.
DirectionFit fit_direction(std::span<const LaunchDirection> kicks);

}  // namespace trivela::kicking
