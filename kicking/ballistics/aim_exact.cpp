#include "kicking/ballistics/aim_exact.hpp"

#include <cmath>

#include "kicking/ballistics/bracketed_root.hpp"

namespace trivela::kicking {
namespace {

/// A function's value and slope.
struct Step {
  double value;
  double slope;
};

/// Newton's root of a function that rises through it; none where that does not settle within a few steps.
template <typename Function>
OptionalDouble newton(double start, const Function& f) {
  double x = start;
  for (int i = 0; i < 8; ++i) {
    const auto [value, slope] = f(x);
    const double change = value / slope;
    if (!(slope > 0.0) || !(std::abs(change) < 0.5 * x)) return std::nullopt;
    x -= change;
    if (std::abs(change) < 1e-9 * x) return x;  // the next change would be its square
  }
  return std::nullopt;
}

}  // namespace

std::optional<Aim> aim_exact(const FlightPoint& point, const Elevation& exit_angle, const Carry& carry,
                             double gravity_mps2) {
  const double d = point.distance_m;
  const double tangent = exit_angle.tangent();
  const double drop = d * tangent - point.height_m;
  if (!(d > 0.0 && drop > 0.0)) return std::nullopt;

  const auto rise_m = [&](double t) { return point.height_m + 0.5 * gravity_mps2 * t * t; };
  const auto excess_m = [&](double t) {
    const double along = d - carry.along_mps * t;
    const double right = carry.right_mps * t;
    return rise_m(t) / tangent - std::sqrt(along * along + right * right);
  };
  const double t_at_rest = std::sqrt(2.0 * drop / gravity_mps2);
  OptionalDouble t = newton(t_at_rest, [&](double at) {
    const double along = d - carry.along_mps * at, right = carry.right_mps * at;
    const double norm = std::sqrt(along * along + right * right);
    const double slope = gravity_mps2 * at / tangent + (along * carry.along_mps - right * carry.right_mps) / norm;
    return Step{rise_m(at) / tangent - norm, slope};
  });
  if (!t) {
    const auto t_long = doubled_until_positive(excess_m, t_at_rest, 1e4 * t_at_rest);
    if (!t_long) return std::nullopt;
    t = bracketed_root(excess_m, 0.0, *t_long);
  }
  if (!t || !(d / *t > carry.along_mps)) return std::nullopt;
  return Aim{rise_m(*t) / (*t * exit_angle.sine), *t, carry.right_mps, d / *t - carry.along_mps};
}

}  // namespace trivela::kicking
