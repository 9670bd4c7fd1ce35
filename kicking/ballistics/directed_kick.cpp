#include "kicking/ballistics/directed_kick.hpp"

namespace trivela::kicking {

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
