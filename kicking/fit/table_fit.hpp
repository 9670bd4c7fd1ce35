#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kicking/fit/least_squares.hpp"
#include "kicking/model/power_table.hpp"

namespace trivela::kicking {

/// One kick of a calibration: a set-point and how the ball left.
struct Trial {
  double power = 0.0;
  double exit_angle_rad = 0.0;  ///< NaN: nobody saw it
  double exit_speed_mps = 0.0;
};

/// Trial of a lob of height H and distance D, both of the ball's centre relative to the launch (paper, section 2.2).
/// Throws std::invalid_argument unless both are positive.
Trial trial_of_lob(double power, double height_m, double distance_m);

/// All trials of one power.
struct TrialMean {
  double power = 0.0;
  int trials = 0;
  Spread exit_speed_mps;  ///< sd NaN for a single trial; the mean after the isotonic fit, where that was asked for
  Spread exit_angle_rad;  ///< of the trials whose angle was seen; NaN: none
};

struct TableOptions {
  /// Least power whose angles count for the mean: CAMBADA's own map leaves the weak kicks out. None: all.
  std::optional<double> least_angle_power = {};
  /// Make a table that does not rise usable: pool adjacent violators, weighted by trials. Set-points of one pool get
  /// its mean, 2 mm/s from one to the next, less where a neighbour is nearer, so that the table rises.
  bool isotonic = false;
};

/// A table with the figures behind it.
struct TableFit {
  std::vector<TrialMean> set_points;  ///< powers rising
  Estimate exit_angle_rad;            ///< mean over the trials that count, as in the paper
  std::size_t exit_angles = 0;        ///< trials that it is the mean of
  double angle_spread_rad = 0.0;      ///< greatest less least mean angle of a set-point
  double exit_speed_sd_mps =
      kNotKnown;  ///< from kick to kick, pooled over the set-points; NaN: no power has two trials
  double exit_speed_sd_ratio = kNotKnown;  ///< the same of each set-point's own speed
  double exit_speed_se_ratio = kNotKnown;  ///< of a set-point's mean, root mean square over the set-points
  double exit_angle_sd_rad = kNotKnown;    ///< from kick to kick, pooled over the set-points, measurement included
  std::vector<std::size_t> not_rising;     ///< set-points not faster than an earlier one, before the isotonic fit
  bool isotonic = false;                   ///< the isotonic fit changed the speeds
  std::vector<double> residual_mps;        ///< trial - speed of its set-point, in the order of the trials
  std::string shared_angle_warning;        ///< why one mean angle is wrong for some set-points; empty: it is not
  std::vector<std::string> warnings;       ///< single trials, angles that differ by more than 1 degree

  /// Does each speed lie above its predecessor?
  bool rises() const;
  /// Throws std::invalid_argument naming the set-point unless it rises.
  std::vector<SetPoint> table() const;
};

/// Averages the trials of each power.
/// Throws std::invalid_argument for fewer than two powers or more than PowerTable holds, and for a power, angle or
/// speed that is not finite and positive, or an angle of 90 degrees or more.
TableFit fit_table(std::span<const Trial> trials, const TableOptions& options = {});

/// Speed of a set-point and the number of trials behind it.
struct WeightedSpeed {
  double speed_mps = 0.0;
  double weight = 1.0;
};

/// The strictly rising speeds nearest to the given ones [m/s]: isotonic least squares by pooling adjacent violators
/// (Barlow et al. 1972), then the members of a pool 2 mm/s from one to the next around its mean, less where the next
/// pool is nearer. Speeds that rise by 2 mm/s or more come back unchanged.
std::vector<double> rising_speeds(std::span<const WeightedSpeed> speeds);

}  // namespace trivela::kicking
