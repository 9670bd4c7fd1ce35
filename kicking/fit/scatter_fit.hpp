#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kicking/fit/least_squares.hpp"

namespace trivela::kicking {

/// Order to release of the ball over repeated kicks.
struct DelayFit {
  Estimate mean_s;                    ///< of the readings kept, se = sd / sqrt(n)
  double sd_s = 0.0;                  ///< from kick to kick, measurement included
  double median_s = 0.0;              ///< of all readings
  double mad_s = 0.0;                 ///< median absolute deviation from it
  std::vector<std::size_t> rejected;  ///< readings left out, from 0
  std::vector<double> residual_s;     ///< reading - mean, of all readings
};

/// A reading farther from the median than 3.5 scales is left out; scale = 1.4826 MAD, but no less than `least_scale_s`.
/// The default, 6 ms, is the standard deviation of a uniform control cycle of 20 ms.
/// Throws std::invalid_argument for fewer than two readings or one that is not finite.
DelayFit fit_delay(std::span<const double> delays_s, double least_scale_s = 0.006);

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
