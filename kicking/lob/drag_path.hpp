#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace trivela::kicking::lob {

/// Free flight with drag at given instants: d2p/dt2 = -k |v| v + l |v| (-v_z, v_x) - g e_z, l the lift of a spinning
/// ball, upwards of its path where positive (backspin, Magnus). Runge-Kutta of order 4 in steps of 25 ms at most (1e-7
/// m). `start` is (x, z, v_x, v_z) at t = 0; `times_s` ascend and may be negative. `states` is overwritten.
void fly_at_times(const Eigen::Vector4d& start, double drag_per_m, std::span<const double> times_s,
                  std::vector<Eigen::Vector4d>& states, double lift_per_m = 0.0);

}  // namespace trivela::kicking::lob
