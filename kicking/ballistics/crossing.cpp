#include "kicking/ballistics/crossing.hpp"

#include <cmath>

namespace trivela::kicking {

double height_at(double distance_m, double v_h_mps, double v_z_mps, double gravity_mps2) {
  const double t = distance_m / v_h_mps;
  return v_z_mps * t - 0.5 * gravity_mps2 * t * t;
}

std::optional<double> crossing_speed(const FlightPoint& point, const Elevation& exit_angle, double gravity_mps2) {
  const double d = point.distance_m;
  const double drop = d * exit_angle.tangent() - point.height_m;  // below the line of the kick, at d
  if (!(d > 0.0 && drop > 0.0)) return std::nullopt;
  return d / exit_angle.cosine * std::sqrt(0.5 * gravity_mps2 / drop);
}

bool descends_through(const FlightPoint& point, const Elevation& exit_angle) {
  return point.height_m < 0.5 * point.distance_m * exit_angle.tangent();
}

double extended_range(const FlightPoint& point, const Elevation& exit_angle) {
  return point.distance_m + point.height_m / exit_angle.tangent();
}

}  // namespace trivela::kicking
