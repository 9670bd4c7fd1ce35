#include "kicking/lob/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trivela::kicking::lob {
namespace {

constexpr int kBeamsMissing = 2;  // dropouts within one thing

bool hang_together(const BeamReturn& a, const BeamReturn& b, double step_rad, double gap_m) {
  const int beams = b.beam - a.beam;
  if (beams > kBeamsMissing + 1) return false;
  const double limit_m = gap_m + beams * step_rad * std::max(a.range_m, b.range_m);
  const double cos_ab = a.cos_a * b.cos_a + a.sin_a * b.sin_a;
  const double apart2 = a.range_m * a.range_m + b.range_m * b.range_m - 2.0 * a.range_m * b.range_m * cos_ab;
  return apart2 <= limit_m * limit_m;
}

}  // namespace

void find_clusters(std::span<const BeamReturn> returns, double step_rad, double gap_m, std::vector<Cluster>& found) {
  found.clear();
  std::size_t first = 0;
  for (std::size_t i = 1; i <= returns.size(); ++i) {
    if (i < returns.size() && hang_together(returns[i - 1], returns[i], step_rad, gap_m)) continue;
    if (i - first >= 2) found.push_back({first, i - 1});
    first = i;
  }
}

namespace {

constexpr double kStray_m = 0.03;  // three times the noise of a return

/// The direction in the middle of the two outer returns, and the angle from there to either.
struct Middle {
  double cos_a;
  double sin_a;
  double half_span_rad;
};

Middle middle_of(std::span<const BeamReturn> cluster) {
  const BeamReturn &low = cluster.front(), &high = cluster.back();
  const double x = low.cos_a + high.cos_a, z = low.sin_a + high.sin_a, length = std::hypot(x, z);
  return {x / length, z / length, std::acos(std::min(1.0, 0.5 * length))};
}

/// Range that the beam reads of a ball at c; beside the ball that of its edge.
double read(const BeamReturn& beam, const PlanePoint& c, double radius_m) {
  const double along = c.x * beam.cos_a + c.z * beam.sin_a;
  const double q = c.x * beam.sin_a - c.z * beam.cos_a;
  return along - std::sqrt(std::max(0.0, radius_m * radius_m - q * q));
}

/// Best ball in one direction u: distance D by two steps of Gauss and Newton, dm_i/dD = cos d_i + D sin^2 d_i /
/// depth_i. The slope is without bound at the very edge; it is held at what it is a fiftieth of the radius inside.
struct InDirection {
  double distance_m;
  double cost_m2;
};

InDirection best_in_direction(std::span<const BeamReturn> cluster, const PlanePoint& u, double distance_m,
                              double radius_m) {
  for (int i = 0;; ++i) {
    double cost = 0.0, gradient = 0.0, curvature = 0.0;
    for (const BeamReturn& beam : cluster) {
      const double cos_d = u.x * beam.cos_a + u.z * beam.sin_a, sin_d = u.x * beam.sin_a - u.z * beam.cos_a;
      const double q = distance_m * sin_d, depth = std::sqrt(std::max(0.0, radius_m * radius_m - q * q));
      const double error = beam.range_m - (distance_m * cos_d - depth);
      const double slope = cos_d + q * sin_d / std::max(depth, 0.2 * radius_m);
      cost += error * error;
      gradient += slope * error;
      curvature += slope * slope;
    }
    if (i == 2) return {distance_m, cost};
    distance_m += gradient / curvature;
  }
}

/// Of the beam that looks at c; the beams of a cluster are evenly spaced in angle and time.
std::int64_t time_through(std::span<const BeamReturn> cluster, const PlanePoint& c) {
  const BeamReturn &low = cluster.front(), &high = cluster.back();
  const double to_centre = std::atan2(low.cos_a * c.z - low.sin_a * c.x, low.cos_a * c.x + low.sin_a * c.z);
  const double to_high =
      std::atan2(low.cos_a * high.sin_a - low.sin_a * high.cos_a, low.cos_a * high.cos_a + low.sin_a * high.sin_a);
  return low.t_ns + std::llround(to_centre / to_high * static_cast<double>(high.t_ns - low.t_ns));
}

/// Angle covered over the angle that a ball at this distance covers.
double chord_ratio(const BeamReturn& first, const BeamReturn& last, double step_rad, double distance_m,
                   double radius_m) {
  const double covered = (last.beam - first.beam + 1) * step_rad;
  return covered / (2.0 * std::asin(std::min(1.0, radius_m / distance_m)));
}

}  // namespace

PlanePoint middle_of_limits(std::span<const BeamReturn> cluster, double radius_m) {
  const BeamReturn &low = cluster.front(), &high = cluster.back();
  const double x = 0.5 * (low.range_m * low.cos_a + high.range_m * high.cos_a);
  const double z = 0.5 * (low.range_m * low.sin_a + high.range_m * high.sin_a);
  const double scale = 1.0 + radius_m / std::hypot(x, z);
  return {scale * x, scale * z};
}

CircleFit circle_of_known_radius(std::span<const BeamReturn> cluster, double radius_m) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 16;  // to half a thousandth of the interval
  const Middle middle = middle_of(cluster);
  const double guess_m = cluster[cluster.size() / 2].range_m + radius_m;
  const auto turned = [&](double angle) {
    const double cos_t = std::cos(angle), sin_t = std::sin(angle);
    return PlanePoint{middle.cos_a * cos_t - middle.sin_a * sin_t, middle.sin_a * cos_t + middle.cos_a * sin_t};
  };
  const auto cost = [&](double angle) { return best_in_direction(cluster, turned(angle), guess_m, radius_m).cost_m2; };
  // Every return is of the ball, so that its centre is less than asin(r / D) away from each.
  const double room = std::asin(std::min(1.0, radius_m / guess_m)) - middle.half_span_rad;
  double low = -std::max(0.0, room), high = -low;
  double inner_low = high - kGolden * (high - low), inner_high = low + kGolden * (high - low);
  double cost_low = cost(inner_low), cost_high = cost(inner_high);
  for (int i = 0; i < kSteps && room > 0.0; ++i) {
    if (cost_low < cost_high) {
      high = std::exchange(inner_high, inner_low);
      cost_high = cost_low;
      inner_low = high - kGolden * (high - low);
      cost_low = cost(inner_low);
    } else {
      low = std::exchange(inner_low, inner_high);
      cost_low = cost_high;
      inner_high = low + kGolden * (high - low);
      cost_high = cost(inner_high);
    }
  }
  const PlanePoint u = turned(0.5 * (low + high));
  const InDirection best = best_in_direction(cluster, u, guess_m, radius_m);
  return {{best.distance_m * u.x, best.distance_m * u.z}, best.cost_m2};
}

std::span<const BeamReturn> without_mixed_pixels(std::span<const BeamReturn> cluster, CircleFit& fit, double radius_m) {
  const auto stray = [&](const BeamReturn& beam) {
    return std::abs(beam.range_m - read(beam, fit.centre, radius_m)) > kStray_m;
  };
  if (cluster.size() < 4 || !(stray(cluster.front()) || stray(cluster.back()))) return cluster;
  const auto all = cluster;
  double least = fit.cost_m2;
  for (const auto& [first, last] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}}) {
    const auto part = all.subspan(first, all.size() - first - last);
    const CircleFit of_part = circle_of_known_radius(part, radius_m);
    const double cost = of_part.cost_m2 + (first + last) * kStray_m * kStray_m;
    if (cost >= least) continue;
    least = cost;
    fit = of_part;
    cluster = part;
  }
  return cluster;
}

std::optional<BallCentre> find_ball(std::span<const BeamReturn> cluster, double step_rad,
                                    const AnalyzerConfig& config) {
  const double radius_m = config.ball.radius_m;
  const double guessed_m = cluster[cluster.size() / 2].range_m + radius_m;
  const double guessed = chord_ratio(cluster.front(), cluster.back(), step_rad, guessed_m, radius_m);
  if (guessed < 0.5 || guessed > 2.0) return std::nullopt;  // spares a person the circle fit
  const bool paper = config.centre == CentreMethod::kMiddleOfLimits;
  PlanePoint c;
  if (paper) {
    c = middle_of_limits(cluster, radius_m);
  } else {
    CircleFit fit = circle_of_known_radius(cluster, radius_m);
    cluster = without_mixed_pixels(cluster, fit, radius_m);
    c = fit.centre;
  }
  const double ratio = chord_ratio(cluster.front(), cluster.back(), step_rad, std::hypot(c.x, c.z), radius_m);
  if (std::abs(ratio - 1.0) > config.chord_tolerance) return std::nullopt;
  return BallCentre{.t_ns = time_through(cluster, c),
                    .x_m = c.x,
                    .z_m = c.z,
                    .returns = static_cast<int>(cluster.size()),
                    .chord_ratio = ratio};
}

}  // namespace trivela::kicking::lob
