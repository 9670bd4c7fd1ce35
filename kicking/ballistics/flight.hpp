#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/constants.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::kicking {

/// A ball at an instant: its centre in F, z over the floor, and its velocity over ground.
struct FlightState {
  Eigen::Vector3d position_m{0.0, 0.0, 0.0};
  Eigen::Vector3d velocity_mps{0.0, 0.0, 0.0};
};

/// a = -k |v| v - g e_z of a ball in the air [m/s2].
inline Eigen::Vector3d drag_acceleration(const Eigen::Vector3d& v, double drag_per_m,
                                         double gravity_mps2 = kGravity_mps2) {
  // Not norm(), which adds in the order that suits the machine.
  const double speed = std::sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z());
  return -drag_per_m * speed * v - Eigen::Vector3d(0.0, 0.0, gravity_mps2);
}

/// Moves a ball in the air by one step of Runge and Kutta's method of order 4.
void fly(FlightState& ball, double dt_s, double drag_per_m, double gravity_mps2 = kGravity_mps2);

/// The ball in one frame of the flight camera: its centre in F, z over the floor.
struct Sighting {
  std::int64_t t_ns = 0;  ///< exposure
  Eigen::Vector3d ball_m{0.0, 0.0, 0.0};
};

/// Least squares of p(t) = position + velocity t through sightings, `time_s` and `place_m` taken from each. None: fewer
/// than two distinct times.
template <typename Time, typename Place>
std::optional<FlightState> fit_line(std::span<const Sighting> sightings, const Time& time_s, const Place& place_m) {
  const auto n = static_cast<double>(sightings.size());
  double mean_t_s = 0.0, spread_s2 = 0.0;
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  for (const Sighting& s : sightings) {
    mean_t_s += time_s(s) / n;
    mean_m += place_m(s) / n;
  }
  for (const Sighting& s : sightings) {
    const double away_s = time_s(s) - mean_t_s;
    spread_s2 += away_s * away_s;
    moment += away_s * (place_m(s) - mean_m);
  }
  if (!(spread_s2 > 0.0)) return std::nullopt;
  const Eigen::Vector3d velocity_mps = moment / spread_s2;
  return FlightState{mean_m - velocity_mps * mean_t_s, velocity_mps};
}

/// Least squares of a free flight p(t) = p0 + v0 t + g t^2 / 2 through sightings, g = (0, 0, -9.81) m/s2, or 0 for a
/// rolling ball; drag neglected: over ten frames its effect is below a centimetre. The state at the first sighting.
/// None: fewer than two distinct instants.
std::optional<FlightState> fit_flight(std::span<const Sighting> sightings, double gravity_mps2);

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
