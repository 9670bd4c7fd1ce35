#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "kicking/constants.hpp"

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

}  // namespace trivela::kicking
