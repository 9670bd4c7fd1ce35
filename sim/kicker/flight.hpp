#pragma once

#include "kicking/ballistics/flight.hpp"
#include "sim/scenario.hpp"

namespace trivela::sim {

/// The free ball, in F.
struct BallMotion : kicking::FlightState {
  bool rolling = false;  ///< stays on the floor
  double rim_mps = 0.0;  ///< speed of its surface by its spin, forward; kept where the floor has friction
  bool bounced = false;  ///< has touched the floor since it was released
};

/// k of the drag a = -k |v| v [1/m]: k = rho C_d pi r^2 / (2 m).
double drag_per_m(const BallPhysics& ball);

/// Moves the ball for dt [s], a control cycle at most.
///   In the air:  dv/dt = -k |v| v - g e_z, Runge-Kutta of order 4.
///   Bounce:      at z = r, v_z -> -e v_z, horizontal v -> retention v; slower than roll_below_mps it rolls from there.
///   Rolling:     dv/dt = -(a_roll + k v^2) v / |v| until it rests.
/// With friction mu = sliding_friction_ratio > 0 a thin-walled ball has the surface speed s (0 at the release), and the
/// floor acts on the slip v - s (R. Cross, Am. J. Phys. 70, 1093, 2002):
///   Bounce:      v -> v - J, s -> s + 3 J / 2, J = min(mu (1 + e) |v_z|, 2 (v - s) / 5)
///   Sliding:     dv/dt = -mu g - k v^2, ds/dt = 3 mu g / 2 until s = v; then it rolls.
/// Other spin, and lift, are not modelled.
void advance(BallMotion& motion, const BallPhysics& ball, double dt_s);

/// The ball neither flies nor moves.
bool at_rest(const BallMotion& motion);

}  // namespace trivela::sim
