#pragma once

#include <span>

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

}  // namespace trivela::kicking
