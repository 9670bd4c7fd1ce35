#include "kicking/ballistics/flight.hpp"

#include "kicking/ballistics/numerics.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::kicking {

void fly(FlightState& ball, double dt_s, double drag_per_m, double gravity_mps2) {
  using Eigen::Vector3d;
  const Vector3d v1 = ball.velocity_mps;
  const auto& [a1, a2, a3, a4] =
      slopes(v1, dt_s, [&](const Vector3d& v) { return drag_acceleration(v, drag_per_m, gravity_mps2); });
  const Vector3d v2 = v1 + 0.5 * dt_s * a1, v3 = v1 + 0.5 * dt_s * a2, v4 = v1 + dt_s * a3;
  // Not runge_kutta(): its sum, in another order, would change the last bits of every simulated match.
  const auto step = [&](Vector3d& x, const Vector3d& k1, const Vector3d& k2, const Vector3d& k3, const Vector3d& k4) {
    x += dt_s / 6.0 * (k1 + 2.0 * k2);
    x += dt_s / 6.0 * (k4 + 2.0 * k3);
  };
  step(ball.position_m, v1, v2, v3, v4);
  step(ball.velocity_mps, a1, a2, a3, a4);
}

std::optional<FlightState> fit_flight(std::span<const Sighting> sightings, double gravity_mps2) {
  const auto time_s = [&](const Sighting& s) { return seconds(sightings.front().t_ns, s.t_ns); };
  return fit_line(sightings, time_s, [&](const Sighting& s) -> Eigen::Vector3d {
    const double t_s = time_s(s);
    return s.ball_m + Eigen::Vector3d{0.0, 0.0, gravity_mps2 * t_s * t_s / 2.0};
  });
}

namespace {

/// In the plane of the flight: x, z, v_x, v_z.
using PlaneState = Eigen::Vector4d;

/// d/dt of the state with drag, gravity and lift.
auto plane_rate(double drag_per_m, double lift_per_m) {
  return [=](const PlaneState& s) {
    const double speed = std::hypot(s[2], s[3]), damping = drag_per_m * speed, turning = lift_per_m * speed;
    return PlaneState(s[2], s[3], -damping * s[2] - turning * s[3], -kGravity_mps2 - damping * s[3] + turning * s[2]);
  };
}

}  // namespace

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
  const auto rate = plane_rate(drag_per_m, lift_per_m);
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

OptionalDouble crossing_speed_with_drag(const FlightPoint& point, double exit_angle_rad, double drag_per_m,
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
