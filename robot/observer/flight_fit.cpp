#include "robot/observer/flight_fit.hpp"

namespace trivela::robot {

Eigen::Vector3d FlightPiece::at(double t_s) const {
  return position_m + velocity_mps * t_s - Eigen::Vector3d{0.0, 0.0, gravity_mps2 * t_s * t_s / 2.0};
}

std::optional<FlightPiece> fit_flight(std::span<const Sighting> sightings, double gravity_mps2) {
  if (sightings.size() < 2) return std::nullopt;
  FlightPiece piece;
  piece.t0_ns = sightings.front().t_ns;
  piece.gravity_mps2 = gravity_mps2;
  const auto n = static_cast<double>(sightings.size());
  const auto time_s = [&](const Sighting& s) { return static_cast<double>(s.t_ns - piece.t0_ns) * 1e-9; };
  const auto without_gravity = [&](const Sighting& s) -> Eigen::Vector3d {
    const double t_s = time_s(s);
    return s.ball_m + Eigen::Vector3d{0.0, 0.0, gravity_mps2 * t_s * t_s / 2.0};
  };
  double mean_t_s = 0.0, spread_t_s2 = 0.0;
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const Sighting& s : sightings) {
    mean_t_s += time_s(s) / n;
    mean_m += without_gravity(s) / n;
  }
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const Sighting& s : sightings) {
    const double away_s = time_s(s) - mean_t_s;
    spread_t_s2 += away_s * away_s;
    moment += away_s * (without_gravity(s) - mean_m);
  }
  if (spread_t_s2 <= 0.0) return std::nullopt;
  piece.velocity_mps = moment / spread_t_s2;
  piece.position_m = mean_m - piece.velocity_mps * mean_t_s;
  return piece;
}

}  // namespace trivela::robot
