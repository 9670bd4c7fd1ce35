#include "kicking/ballistics/moving_kick.hpp"

#include <cmath>

namespace trivela::kicking {

double moving_kick_paper(double v0_mps, double u_mps, const Elevation& exit_angle) {
  return v0_mps - u_mps * exit_angle.cosine;
}

OptionalDouble moving_kick_exact(const FlightPoint& point, const Elevation& exit_angle, double u_mps,
                                 double gravity_mps2) {
  const double d = point.distance_m;
  const double h = point.height_m;
  const double c = exit_angle.cosine;
  const double s = exit_angle.sine;
  const double quadratic = c * (d * s - h * c);
  const double linear = u_mps * (d * s - 2.0 * h * c);
  const double constant = h * u_mps * u_mps + 0.5 * gravity_mps2 * d * d;
  if (!(d > 0.0 && quadratic > 0.0 && constant > 0.0)) return std::nullopt;
  const double root = std::sqrt(linear * linear + 4.0 * quadratic * constant);
  return linear > 0.0 ? 2.0 * constant / (root + linear) : (root - linear) / (2.0 * quadratic);
}

std::optional<DirectedKick> directed_kick(const LineAhead& line, double height_m, const Elevation& exit_angle,
                                          double gravity_mps2) {
  if (!(line.toward_ratio > 0.0)) return std::nullopt;
  const double steepness =
      exit_angle.sine / (exit_angle.cosine * line.toward_ratio);  // rise over distance towards the line
  const double drop = steepness * line.distance_m - height_m;
  if (!(drop > 0.0)) return std::nullopt;
  const double b = steepness * line.carried_mps;
  const double root = std::sqrt(b * b + 2.0 * gravity_mps2 * drop);
  const double t = b > 0.0 ? 2.0 * drop / (root + b) : (root - b) / gravity_mps2;
  const double v = (line.distance_m / t - line.carried_mps) / (exit_angle.cosine * line.toward_ratio);
  if (!(v > 0.0 && std::isfinite(v))) return std::nullopt;
  return DirectedKick{v, t};
}

}  // namespace trivela::kicking
