#include "kicking/ballistics/drag.hpp"

#include <cmath>

#include "kicking/ballistics/bracketed_root.hpp"
#include "kicking/ballistics/runge_kutta.hpp"

namespace trivela::kicking {
namespace {

/// In the plane of the flight: x, z, v_x, v_z.
using PlaneState = Eigen::Vector4d;

/// d/dt of the state with drag, gravity and lift.
auto plane_rate(double drag_per_m, double gravity_mps2, double lift_per_m = 0.0) {
  return [=](const PlaneState& s) {
    const double speed = std::hypot(s[2], s[3]), damping = drag_per_m * speed, turning = lift_per_m * speed;
    return PlaneState(s[2], s[3], -damping * s[2] - turning * s[3], -gravity_mps2 - damping * s[3] + turning * s[2]);
  };
}

}  // namespace

DragFlight fly_with_drag(double v0_mps, double exit_angle_rad, double drag_per_m, double gravity_mps2) {
  using State = PlaneState;
  constexpr double kStep_s = 2e-3;
  const auto rate = plane_rate(drag_per_m, gravity_mps2);
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

DragCrossing cross_with_drag(double distance_m, double v0_mps, double exit_angle_rad, double drag_per_m,
                             double gravity_mps2) {
  using State = Eigen::Vector4d;  // z, v_x, v_z, t, all over x
  constexpr int kSteps = 32;
  const auto rate = [&](const State& s) {
    const double damping = drag_per_m * std::hypot(s[1], s[2]);
    return State(s[2] / s[1], -damping, (-gravity_mps2 - damping * s[2]) / s[1], 1.0 / s[1]);
  };
  State state(0.0, v0_mps * std::cos(exit_angle_rad), v0_mps * std::sin(exit_angle_rad), 0.0);
  for (int i = 0; i < kSteps; ++i) state = runge_kutta(state, distance_m / kSteps, rate);
  return {state[0], state[3]};
}

void fly_at_times(const Eigen::Vector4d& start, double drag_per_m, std::span<const double> times_s,
                  std::vector<Eigen::Vector4d>& states, double lift_per_m) {
  constexpr double kLongestStep_s = 0.025;
  const auto rate = plane_rate(drag_per_m, kGravity_mps2, lift_per_m);
  states.clear();
  PlaneState state = start;
  double t_s = 0.0;
  for (const double next_s : times_s) {
    const double duration_s = next_s - t_s;
    const int steps = 1 + static_cast<int>(std::abs(duration_s) / kLongestStep_s);
    for (int i = 0; i < steps; ++i) state = runge_kutta(state, duration_s / steps, rate);
    t_s = next_s;
    states.push_back(state);
  }
}

std::optional<double> crossing_speed_with_drag(const FlightPoint& point, double exit_angle_rad, double drag_per_m,
                                               double gravity_mps2) {
  const auto vacuum_mps = crossing_speed(point, exit_angle_rad, gravity_mps2);
  if (!vacuum_mps || drag_per_m <= 0.0) return vacuum_mps;
  const auto excess_m = [&](double v0_mps) {
    return cross_with_drag(point.distance_m, v0_mps, exit_angle_rad, drag_per_m, gravity_mps2).height_m -
           point.height_m;
  };
  const auto high = doubled_until_positive(excess_m, *vacuum_mps, 200.0);
  if (!high) return std::nullopt;
  return bracketed_root(excess_m, *vacuum_mps, *high);
}

}  // namespace trivela::kicking
