#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kicking/constants.hpp"
#include "kicking/fit/least_squares.hpp"

namespace trivela::kicking {

/// How the ball left, as a camera's track of it says.
struct TrackedLaunch {
  double along_mps = 0.0;  ///< over ground, along the pointing line
  double up_mps = 0.0;
  double weight = 1.0;  ///< inverse variance of the velocity, up to a factor
};

/// One kick of a robot that drives towards the goal or away from it.
struct TransferRow {
  double vy_mps = 0.0;          ///< forward
  double v0_mps = 0.0;          ///< exit speed of the power for a robot at rest, effective
  double exit_angle_rad = 0.0;  ///< of that power
  double distance_m = 0.0;      ///< ball to goal line along the pointing line, at the order
  double z_cross_m = 0.0;       ///< height of the ball's centre over the floor, at the goal line; not used with a track
  std::optional<TrackedLaunch> track = {};

  static constexpr double kLeastSpeed_mps = 0.05;
  /// Slower than kLeastSpeed_mps: a reference for the others.
  bool at_rest() const { return std::abs(vy_mps) < kLeastSpeed_mps; }
};

/// Constants of one direction of driving.
struct TransferDirection {
  int kicks = 0;
  Estimate exact;                 ///< k of u = k v in the exact law
  Estimate paper;                 ///< k of V_kick = V0 - k v cos(theta) (paper, section 2.2)
  std::vector<std::size_t> rows;  ///< of the input, from 0
  std::vector<double> residual;   ///< measured - fitted: height [m], of tracked kicks the speed along [m/s]
  double rms = 0.0;
};

/// Forward and backward apart. None: no two kicks in that direction, or none that a k explains.
struct TransferFit {
  /// Speed that the heights of the kicks at rest need, over the row's V0: what every V0 is multiplied by. None: fewer
  /// than two such kicks, V0 is taken as it is. Of tracked kicks: effective over tracked speed along.
  std::optional<Estimate> standing_ratio;
  std::optional<TransferDirection> forward;
  std::optional<TransferDirection> backward;
  std::vector<std::string> failed;  ///< "backward: ..." of a direction that has kicks and no fit
};

/// Least squares in height of the exact law: from d - v tau with v_h = V0 cos(theta) + k v, T = d / v_h,
/// z = r + V0 sin(theta) T - g T^2 / 2. The paper's k is the slope of V0(d, h) - V_kick over v cos(theta), where V0(d,
/// h) is the speed that a robot at rest needs for the height observed. Kicks slower than 0.05 m/s are the reference:
/// they say what the V0 of the rows really were, so that an error of the table is not taken for transfer (at 1 m/s and
/// 4 m one per cent of speed is worth 0.17 of k). Standard errors contain the reference's. `delay_s`: order to release.
/// A direction that fails leaves the other one standing. Where every row has a track: fit_tracked_transfer().
/// Throws std::invalid_argument where no direction has a fit, and for a value that is not finite or positive where it
/// must be.
TransferFit fit_transfer(std::span<const TransferRow> rows, double delay_s, double ball_radius_m = Ball{}.radius_m,
                         double gravity_mps2 = kGravity_mps2);

}  // namespace trivela::kicking
