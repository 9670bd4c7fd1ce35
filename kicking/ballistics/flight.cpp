#include "kicking/ballistics/flight.hpp"

#include "kicking/ballistics/runge_kutta.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::kicking {

void fly(FlightState& ball, double dt_s, double drag_per_m, double gravity_mps2) {
  using State = Eigen::Matrix<double, 6, 1>;
  State state;
  state << ball.position_m, ball.velocity_mps;
  const auto& [k1, k2, k3, k4] = slopes(state, dt_s, [&](const State& s) {
    State rate;
    rate << s.tail<3>(), drag_acceleration(s.tail<3>(), drag_per_m, gravity_mps2);
    return rate;
  });
  // Not runge_kutta(): its sum, in another order, would change the last bits of every simulated match.
  state += dt_s / 6.0 * (k1 + 2.0 * k2);
  state += dt_s / 6.0 * (k4 + 2.0 * k3);
  ball = {state.head<3>(), state.tail<3>()};
}

std::optional<FlightState> fit_flight(std::span<const Sighting> sightings, double gravity_mps2) {
  const auto time_s = [&](const Sighting& s) { return seconds(sightings.front().t_ns, s.t_ns); };
  return fit_line(sightings, time_s, [&](const Sighting& s) -> Eigen::Vector3d {
    const double t_s = time_s(s);
    return s.ball_m + Eigen::Vector3d{0.0, 0.0, gravity_mps2 * t_s * t_s / 2.0};
  });
}

}  // namespace trivela::kicking
