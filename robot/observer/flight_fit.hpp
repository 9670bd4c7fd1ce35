#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

namespace trivela::robot {

/// One sighting of the flying ball: its centre in F, z above the floor.
struct Sighting {
  std::int64_t t_ns;
  Eigen::Vector3d ball_m;
};

/// A piece of a flight: p(t) = p0 + v0 t + g t^2 / 2 with g = (0, 0, -9.81) m/s2, or 0 for a rolling ball; t since
/// t0_ns.
struct FlightPiece {
  std::int64_t t0_ns = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  double gravity_mps2 = 0.0;

  Eigen::Vector3d at(double t_s) const;
};

/// Least squares of a free flight through sightings (drag neglected: over ten frames its effect is below a centimetre).
/// nullopt for fewer than two distinct instants.
std::optional<FlightPiece> fit_flight(std::span<const Sighting> sightings, double gravity_mps2);

}  // namespace trivela::robot
