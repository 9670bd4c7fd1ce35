#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::kicking {

/// Where a flight with drag crosses a distance; height over the launch, negative: below it.
struct DragCrossing {
  double height_m = 0.0;
  double t_flight_s = 0.0;
};

/// The flight with a = -k |v| v - g at a horizontal distance, by Runge-Kutta of fourth order over x, so that no event
/// has to be found. The speed is a true one; k by drag_per_m.
DragCrossing cross_with_drag(double distance_m, double v0_mps, double exit_angle_rad, double drag_per_m,
                             double gravity_mps2 = kGravity_mps2);

/// Free flight in its plane at given instants: d2p/dt2 = -k |v| v + l |v| (-v_z, v_x) - g e_z, l the lift of a spinning
/// ball, upwards of its path where positive (backspin, Magnus). Runge-Kutta of order 4 in steps of 25 ms at most (1e-7
/// m). `start` is (x, z, v_x, v_z) at t = 0; `times_s` ascend and may be negative. `states` is overwritten.
void fly_at_times(const Eigen::Vector4d& start, double drag_per_m, std::span<const double> times_s,
                  std::vector<Eigen::Vector4d>& states, double lift_per_m = 0.0);

/// True exit speed of the flight with drag through the point [m/s]; none if d tan(theta) <= h or it takes more than 200
/// m/s.
OptionalDouble crossing_speed_with_drag(const FlightPoint& point, double exit_angle_rad, double drag_per_m,
                                        double gravity_mps2 = kGravity_mps2);

}  // namespace trivela::kicking
