#include "kicking/ballistics/flight.hpp"

#include "kicking/ballistics/runge_kutta.hpp"
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

}  // namespace trivela::kicking
