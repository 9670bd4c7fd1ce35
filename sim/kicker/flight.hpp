#pragma once

#include "kicking/ballistics/flight.hpp"
#include "sim/scenario.hpp"

namespace trivela::sim {

/// The free ball, in F.
struct BallMotion : kicking::FlightState {
  bool rolling = false;  ///< stays on the floor
  bool bounced = false;  ///< has touched the floor since it was released
};

/// k of the drag a = -k |v| v [1/m]: k = rho C_d pi r^2 / (2 m).
double drag_per_m(const BallPhysics& ball);

/// Moves the ball for dt [s], a control cycle at most.
///   In the air:  dv/dt = -k |v| v - g e_z, Runge-Kutta of order 4.
///   Bounce:      at z = r, v_z -> -e v_z, horizontal v -> retention v; slower than roll_below_mps it rolls from there.
///   Rolling:     dv/dt = -(a_roll + k v^2) v / |v| until it rests.
/// Spin is not modelled.
void advance(BallMotion& motion, const BallPhysics& ball, double dt_s);

/// The ball neither flies nor moves.
bool at_rest(const BallMotion& motion);

}  // namespace trivela::sim
