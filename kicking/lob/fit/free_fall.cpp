#include "kicking/lob/fit/free_fall.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "kicking/constants.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::kicking::lob {
namespace {

constexpr std::size_t kMostErrors = 256;  // a flight has a hundred; no heap while scans come

}  // namespace

FallingPoint predict_fall(std::span<const BallCentre> centres, std::int64_t t_ns) {
  constexpr double kWindow_s = 0.4;
  double n = 0.0, t1 = 0.0, t2 = 0.0, x1 = 0.0, z1 = 0.0, xt = 0.0, zt = 0.0;
  for (auto centre = centres.rbegin(); centre != centres.rend(); ++centre) {
    const double t = seconds(t_ns, centre->t_ns);
    if (n >= 2.0 && seconds(centre->t_ns, centres.back().t_ns) > kWindow_s) break;
    const double z = centre->z_m + 0.5 * kGravity_mps2 * t * t;
    n += 1.0;
    t1 += t;
    t2 += t * t;
    x1 += centre->x_m;
    z1 += z;
    xt += centre->x_m * t;
    zt += z * t;
  }
  const double spread = t2 - t1 * t1 / n;
  const double v_x = (xt - x1 * t1 / n) / spread, v_z = (zt - z1 * t1 / n) / spread;
  return {(x1 - v_x * t1) / n, (z1 - v_z * t1) / n};
}

bool may_start_flight(const BallCentre& first, const BallCentre& second, const BallCentre& third) {
  constexpr double kSlowest_mps = 2.0, kFastest_mps = 20.0;
  const double dt1 = seconds(first.t_ns, second.t_ns), dt2 = seconds(second.t_ns, third.t_ns);
  if (!(dt1 > 0.0 && dt2 > 0.0)) return false;
  const double v_x = (second.x_m - first.x_m) / dt1, v_z = (second.z_m - first.z_m) / dt1;
  const double speed = std::hypot(v_x, v_z);
  const double x = second.x_m + v_x * dt2;
  const double z = second.z_m + v_z * dt2 - 0.5 * kGravity_mps2 * dt2 * (dt1 + dt2);
  const double off = std::hypot(third.x_m - x, third.z_m - z);
  return speed >= kSlowest_mps && speed <= kFastest_mps && off <= 0.06 + 2.0 * dt2 * dt2;
}

std::optional<VerticalMotion> vertical_motion(std::span<const BallCentre> centres) {
  if (centres.size() < 4) return std::nullopt;
  const double middle_s = 0.5 * seconds(centres.front().t_ns, centres.back().t_ns);
  const auto row = [&](const BallCentre& centre) {
    const double t = seconds(centres.front().t_ns, centre.t_ns) - middle_s;
    return Eigen::Vector3d(1.0, t, 0.5 * t * t);
  };
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  for (const BallCentre& centre : centres) {
    moments += row(centre) * row(centre).transpose();
    sums += row(centre) * centre.z_m;
  }
  const Eigen::LDLT<Eigen::Matrix3d> decomposed(moments);
  const Eigen::Vector3d solution = decomposed.solve(sums);
  double squares = 0.0;
  std::array<double, kMostErrors> errors_m;
  std::size_t kept = 0;
  for (const BallCentre& centre : centres) {
    const double error = centre.z_m - row(centre).dot(solution);
    squares += error * error;
    if (kept < errors_m.size()) errors_m[kept++] = std::abs(error);
  }
  const double variance = squares / (static_cast<double>(centres.size()) - 3.0);
  const double se = std::sqrt(variance * decomposed.solve(Eigen::Matrix3d::Identity())(2, 2));
  return VerticalMotion{{solution[2], se}, upper_median(std::span(errors_m).first(kept))};
}

bool falls_freely(std::span<const BallCentre> centres) {
  // Drag bends a long path away from the parabola, with the cube of the time.
  constexpr double kOff_m = 0.02, kOff_mps3 = 0.02;
  const auto motion = vertical_motion(centres);
  if (!motion || !std::isfinite(motion->acceleration_mps2.value)) return false;
  const auto& [acceleration, se] = motion->acceleration_mps2;
  const double allowed = std::clamp(2.5 * se, 0.35 * kGravity_mps2, 0.7 * kGravity_mps2);
  const double duration_s = seconds(centres.front().t_ns, centres.back().t_ns);
  return std::abs(acceleration + kGravity_mps2) <= allowed &&
         motion->off_m <= kOff_m + kOff_mps3 * std::pow(duration_s, 3);
}

}  // namespace trivela::kicking::lob
