#include "nodes/shot_observer/flight_fit.hpp"

#include <cmath>

namespace trivela::nodes {

Eigen::Vector3d FlightPiece::at(double t_s) const {
  return position_m + velocity_mps * t_s - Eigen::Vector3d{0.0, 0.0, gravity_mps2 * t_s * t_s / 2.0};
}

double FlightPiece::sd_m(double t_s, double ball_sd_m) const {
  const double away_s = t_s - mean_t_s;
  return ball_sd_m * std::sqrt(1.0 / static_cast<double>(sightings) + away_s * away_s / spread_t_s2);
}

std::optional<double> FlightPiece::time_at_y_s(double y_m) const {
  if (velocity_mps.y() <= 0.0) return std::nullopt;
  return (y_m - position_m.y()) / velocity_mps.y();
}

std::optional<FlightPiece> fit_flight(std::span<const Sighting> sightings, double gravity_mps2) {
  if (sightings.size() < 2) return std::nullopt;
  FlightPiece piece;
  piece.t0_ns = sightings.front().t_ns;
  piece.gravity_mps2 = gravity_mps2;
  piece.sightings = sightings.size();
  const auto n = static_cast<double>(sightings.size());
  const auto time_s = [&](const Sighting& s) { return static_cast<double>(s.t_ns - piece.t0_ns) * 1e-9; };
  const auto without_gravity = [&](const Sighting& s) -> Eigen::Vector3d {
    const double t_s = time_s(s);
    return s.ball_m + Eigen::Vector3d{0.0, 0.0, gravity_mps2 * t_s * t_s / 2.0};
  };
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const Sighting& s : sightings) {
    piece.mean_t_s += time_s(s) / n;
    mean_m += without_gravity(s) / n;
  }
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const Sighting& s : sightings) {
    const double away_s = time_s(s) - piece.mean_t_s;
    piece.spread_t_s2 += away_s * away_s;
    moment += away_s * (without_gravity(s) - mean_m);
  }
  if (piece.spread_t_s2 <= 0.0) return std::nullopt;
  piece.velocity_mps = moment / piece.spread_t_s2;
  piece.position_m = mean_m - piece.velocity_mps * piece.mean_t_s;
  return piece;
}

std::span<const Sighting> after_last_bounce(std::span<const Sighting> sightings, double floor_z_m) {
  for (std::size_t i = sightings.size(); i-- > 2;) {
    const double before = sightings[i - 2].ball_m.z();
    const double low = sightings[i - 1].ball_m.z();
    const double after = sightings[i].ball_m.z();
    if (low < floor_z_m && low <= before && low < after) return sightings.subspan(i);
  }
  return sightings;
}

}  // namespace trivela::nodes
