#include "kicking/ballistics/moving_kick.hpp"

#include "kicking/ballistics/numerics.hpp"

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

KickSpeeds kick_speeds(const WantedKick& wanted) {
  const OptionalDouble v0_mps = crossing_speed(wanted.point, wanted.exit_angle, wanted.gravity_mps2);
  if (!v0_mps) return {};
  return {.v0_mps = v0_mps,
          .vk_exact_mps = moving_kick_exact(wanted.point, wanted.exit_angle, wanted.u_mps(), wanted.gravity_mps2),
          .vk_paper_mps = moving_kick_paper(*v0_mps, wanted.u_mps(), wanted.exit_angle),
          .descending = descends_through(wanted.point, wanted.exit_angle)};
}

}  // namespace trivela::kicking
