#include "kicking/ballistics/crossing.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace trivela::kicking {

double height_at(double distance_m, double v_h_mps, double v_z_mps, double gravity_mps2) {
  const double t = distance_m / v_h_mps;
  return v_z_mps * t - 0.5 * gravity_mps2 * t * t;
}

OptionalDouble crossing_speed(const FlightPoint& point, const Elevation& exit_angle, double gravity_mps2) {
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

LobExit exit_from_lob(double apex_m, double range_m, double gravity_mps2) {
  if (!(apex_m > 0.0 && range_m > 0.0)) {
    throw std::invalid_argument("lob: apex_m = " + std::to_string(apex_m) +
                                " and range_m = " + std::to_string(range_m) + " must be positive");
  }
  const double angle = std::atan(4.0 * apex_m / range_m);
  const double speed = std::sqrt(range_m * gravity_mps2 / std::sin(2.0 * angle));
  return {angle, speed, 2.0 * speed * std::sin(angle) / gravity_mps2};
}

}  // namespace trivela::kicking
