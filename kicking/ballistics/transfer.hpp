#pragma once

namespace trivela::kicking {

/// Share of the robot's velocity that the ball takes along, forward, backward and sideways apart. A constant belongs to
/// the law it was fitted in: 0.70 in the paper's law is about what the exact law gives for a full transfer of 1.
struct Transfer {
  double forward = 1.0;
  double backward = 1.0;
  double lateral = 1.0;

  /// Velocity [m/s] along the robot's forward axis that the ball takes over from v_front [m/s].
  constexpr double along_mps(double v_front_mps) const {
    return (v_front_mps < 0.0 ? backward : forward) * v_front_mps;
  }
};

}  // namespace trivela::kicking
