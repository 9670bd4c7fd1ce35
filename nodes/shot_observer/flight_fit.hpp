#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

namespace trivela::nodes {

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
  double mean_t_s = 0.0;     ///< centre of the sightings' times
  double spread_t_s2 = 0.0;  ///< sum of squared deviations of the times from their mean
  std::size_t sightings = 0;

  Eigen::Vector3d at(double t_s) const;

  /// Standard deviation of each coordinate of at(t_s) when one sighting has `ball_sd_m`: sd sqrt(1/n + (t - mean)^2 /
  /// spread).
  double sd_m(double t_s, double ball_sd_m) const;

  /// Time at which y reaches `y_m` going forward; nullopt when it moves away or stands.
  std::optional<double> time_at_y_s(double y_m) const;
};

/// Least squares of a free flight through sightings (drag neglected: over ten frames its effect is below a centimetre).
/// nullopt for fewer than two distinct instants.
std::optional<FlightPiece> fit_flight(std::span<const Sighting> sightings, double gravity_mps2);

/// The part of `sightings` after the last bounce: from the last local minimum of z near the floor on.
std::span<const Sighting> after_last_bounce(std::span<const Sighting> sightings, double floor_z_m);

}  // namespace trivela::nodes
