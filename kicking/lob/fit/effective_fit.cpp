#include "kicking/lob/fit/effective_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

#include "kicking/constants.hpp"

namespace trivela::kicking::lob {

std::optional<Parabola> fit_parabola(std::span<const BallCentre> centres, double launch_z_m) {
  if (centres.size() < 4) return std::nullopt;
  const auto n = static_cast<double>(centres.size());
  double middle_x = 0.0;  // x is counted from there, for the sake of the numerics
  for (const BallCentre& centre : centres) middle_x += centre.x_m / n;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  for (const BallCentre& centre : centres) {
    const double x = centre.x_m - middle_x;
    const Eigen::Vector3d row(1.0, x, -x * x);
    moments += row * row.transpose();
    sums += row * (centre.z_m - launch_z_m);
  }
  const Eigen::LDLT<Eigen::Matrix3d> decomposed(moments);
  const Eigen::Vector3d abc = decomposed.solve(sums);
  const double a = abc[0], b = abc[1], c = abc[2], s = b * b + 4.0 * c * a;
  if (!abc.allFinite() || !(c > 0.0) || !(s > 0.0)) return std::nullopt;

  double squares = 0.0;
  for (const BallCentre& centre : centres) {
    const double x = centre.x_m - middle_x, error = centre.z_m - launch_z_m - (a + b * x - c * x * x);
    squares += error * error;
  }
  const Eigen::Matrix3d covariance = squares / (n - 3.0) * decomposed.solve(Eigen::Matrix3d::Identity());
  const auto estimate = [&](double value, const Eigen::Vector3d& gradient) {
    return Estimate{value, std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)))};
  };
  const Eigen::Vector3d by_c(0.0, 0.0, 1.0), s_by(4.0 * c, 2.0 * b, 4.0 * a);
  const double root = std::sqrt(s), speed = std::sqrt(kGravity_mps2 * (1.0 + s) / (2.0 * c));
  Parabola parabola;
  parabola.values = {.exit_angle_rad = estimate(std::atan(root), s_by / (2.0 * root * (1.0 + s))),
                     .exit_speed_mps = estimate(speed, 0.5 * speed * (s_by / (1.0 + s) - by_c / c)),
                     .height_m = estimate(s / (4.0 * c), s_by / (4.0 * c) - s / (4.0 * c * c) * by_c),
                     .distance_m = estimate(root / c, s_by / (2.0 * root * c) - root / (c * c) * by_c),
                     .residual_rms_m = std::sqrt(squares / n)};
  const bool forward = centres.back().x_m >= centres.front().x_m;
  parabola.apex_x_m = middle_x + b / (2.0 * c);
  parabola.launch_x_m = parabola.apex_x_m + (forward ? -0.5 : 0.5) * root / c;
  return parabola;
}

}  // namespace trivela::kicking::lob
