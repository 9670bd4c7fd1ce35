#include "kicking/ballistics/aim_exact.hpp"

#include <cmath>

#include "kicking/ballistics/bracketed_root.hpp"

namespace trivela::kicking {

std::optional<Aim> aim_exact(const FlightPoint& point, double exit_angle_rad, const Carry& carry, double gravity_mps2) {
  const double d = point.distance_m;
  const double tangent = std::tan(exit_angle_rad);
  const double drop = d * tangent - point.height_m;
  if (!(d > 0.0 && drop > 0.0)) return std::nullopt;

  const auto rise_m = [&](double t) { return point.height_m + 0.5 * gravity_mps2 * t * t; };
  const auto excess_m = [&](double t) {
    const double along = d - carry.along_mps * t;
    const double right = carry.right_mps * t;
    return rise_m(t) / tangent - std::sqrt(along * along + right * right);
  };
  const double t_at_rest = std::sqrt(2.0 * drop / gravity_mps2);
  const auto t_long = doubled_until_positive(excess_m, t_at_rest, 1e4 * t_at_rest);
  if (!t_long) return std::nullopt;
  const auto t = bracketed_root(excess_m, 0.0, *t_long);
  if (!t || !(d / *t > carry.along_mps)) return std::nullopt;
  return Aim{rise_m(*t) / (*t * std::sin(exit_angle_rad)), std::atan2(carry.right_mps, d / *t - carry.along_mps), *t};
}

}  // namespace trivela::kicking
