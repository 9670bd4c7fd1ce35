// Laws that the algorithm is compared with.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/ballistics/moving_kick.hpp"
#include "kicking/ballistics/numerics.hpp"

namespace trivela::kicking {

/// A lob with quadratic drag, from the launch back to its height.
struct DragFlight {
  double range_m = 0.0;
  double t_flight_s = 0.0;
  double apex_m = 0.0;
  double apex_x_m = 0.0;
};

/// Flight with a = -k |v| v - g, integrated by Runge-Kutta of fourth order. The speed is a true one; k by drag_per_m.
inline DragFlight fly_with_drag(double v0_mps, double exit_angle_rad, double drag_per_m) {
  using State = Eigen::Vector4d;  // x, z, v_x, v_z
  constexpr double kStep_s = 2e-3;
  const auto rate = [&](const State& s) {
    const double damping = drag_per_m * std::hypot(s[2], s[3]);
    return State(s[2], s[3], -damping * s[2], -kGravity_mps2 - damping * s[3]);
  };
  // Steps on while the component of the state is positive, then goes back to its zero within the last step.
  const auto fly_to_zero = [&](State state, double t, int component, double& t_zero) {
    while (true) {
      const State next = runge_kutta(state, kStep_s, rate);
      if (next[component] <= 0.0) break;
      state = next;
      t += kStep_s;
    }
    const auto below = [&](double step) { return -runge_kutta(state, step, rate)[component]; };
    const double step = bracketed_root(below, 0.0, kStep_s).value_or(0.0);
    t_zero = t + step;
    return runge_kutta(state, step, rate);
  };

  const State launch(0.0, 0.0, v0_mps * std::cos(exit_angle_rad), v0_mps * std::sin(exit_angle_rad));
  if (!(launch[3] > 0.0)) return {};
  double t_apex = 0.0;
  const State apex = fly_to_zero(launch, 0.0, 3, t_apex);
  double t_landing = 0.0;
  const State landing = fly_to_zero(apex, t_apex, 1, t_landing);
  return {landing[0], t_landing, apex[1], apex[0]};
}

/// The k that makes the paper's law of a moving robot right to first order if the ball takes over all of the robot's
/// velocity: (1 - 2 e) / (2 cos^2(theta) (1 - e)) with e = h / (d tan(theta)); 1 / (2 cos^2(theta)) at infinite
/// distance.
inline double k_geometric(const FlightPoint& point, double exit_angle_rad) {
  const double epsilon = point.height_m / (point.distance_m * std::tan(exit_angle_rad));
  const double c = std::cos(exit_angle_rad);
  return (1.0 - 2.0 * epsilon) / (2.0 * c * c * (1.0 - epsilon));
}

/// Where the kicker points at the release: delta of aim_exact().
inline double left_of_target_rad(const Aim& aim) { return std::atan2(aim.left_mps, aim.toward_mps); }

}  // namespace trivela::kicking
