#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kicking/fit/table_fit.hpp"
#include "kicking/fit/transfer_fit.hpp"

namespace trivela::kicking {

/// fit_transfer() for rows that all have a track: one weighted fit of all kicks, at rest, forward and backward,
///
///     along = c up + k_forward max(v, 0) + k_backward min(v, 0) + scatter
///
/// c: along over up of a robot at rest, which the kicker's scatter of speed leaves alone. Its own speed is what a robot
/// believes of itself, with an error: the nominal speed, the belief rounded to 0.25 m/s (0: a kick at rest), is the
/// instrument, so that the error does not pull the constants towards 0. Standard errors are those of White (HC3): they
/// hold whatever the kicks' scatter depends on.
///
/// The constants of `exact` are those of the drag-free law, in whose speeds everything is smaller than over ground by
/// e = mean(V0 cos(theta)) / (c mean(up)) over the kicks at rest: k e. Full transfer comes out as about 0.95 at 6 m.
/// Throws as fit_transfer(), and std::invalid_argument for fewer than two kicks at rest.
TransferFit fit_tracked_transfer(std::span<const TransferRow> rows, double delay_s, double gravity_mps2);

/// A kick of a standing robot that a camera followed.
struct TrackedTrial {
  double power = 0.0;
  double up_mps = 0.0;            ///< vertical velocity at the launch, by the camera's track
  double sideways_rad = 0.0;      ///< direction of the track from the laser's scan plane
  std::optional<Trial> lob = {};  ///< of the same kick, by the laser
};

struct TrackedTrials {
  std::vector<Trial> trials;  ///< of all kicks; the angle is the laser's, NaN where it lost the kick
  Estimate exit_angle_rad;    ///< in the scan plane
};

/// Trials of all kicks, those that the laser lost included. Where both saw the ball, V = up (a + b up^2 + c s^2) and
/// angle = e + f s^2, least squares: drag takes more from a faster ball, and of one that flies at an angle s to its
/// plane the laser sees a smaller circle, which it takes for another place. Every kick then has V = up (a + b up^2),
/// every angle is taken to the plane. A set-point's mean rests on all its kicks: where the laser keeps one in four, its
/// standard error is half as large. Throws std::invalid_argument for fewer than four kicks that both saw.
TrackedTrials tracked_trials(std::span<const TrackedTrial> kicks);

}  // namespace trivela::kicking
