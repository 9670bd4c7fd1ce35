#include "kicking/model/omni_kinematics.hpp"

#include <Eigen/QR>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace trivela::kicking {
namespace {

[[noreturn]] void refuse_lengths(const WheelBase& base) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "wheel radius %g m and distance %g m must be positive", base.wheel_radius_m,
                base.wheel_distance_m);
  throw std::invalid_argument{text.data()};
}

}  // namespace

OmniKinematics::OmniKinematics(const WheelBase& base) {
  const auto count = static_cast<Eigen::Index>(base.wheel_angles_rad.size());
  if (count != 3 && count != 4)
    throw std::invalid_argument{"an omni base has 3 or 4 wheels, not " + std::to_string(count)};
  if (!(base.wheel_radius_m > 0.0) || !(base.wheel_distance_m > 0.0)) refuse_lengths(base);
  forward_.resize(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double angle = base.wheel_angles_rad[static_cast<std::size_t>(i)];
    forward_.row(i) << -std::sin(angle), std::cos(angle), base.wheel_distance_m;
  }
  forward_ /= base.wheel_radius_m;
  const auto decomposition = forward_.completeOrthogonalDecomposition();
  if (decomposition.rank() < 3) throw std::invalid_argument{"the wheels' directions do not span the plane"};
  backward_ = decomposition.pseudoInverse();
}

Twist OmniKinematics::twist(std::span<const double> wheel_radps) const {
  assert(wheel_radps.size() >= static_cast<std::size_t>(wheel_count()));
  const Eigen::Map<const Eigen::VectorXd> speeds{wheel_radps.data(), backward_.cols()};
  const Eigen::Vector3d v = backward_ * speeds;
  return {v.x(), v.y(), v.z()};
}

std::array<double, 4> OmniKinematics::wheel_speeds_radps(const Twist& twist) const {
  std::array<double, 4> speeds{};
  Eigen::Map<Eigen::VectorXd>{speeds.data(), forward_.rows()} =
      forward_ * Eigen::Vector3d{twist.vx_mps, twist.vy_mps, twist.omega_radps};
  return speeds;
}

Eigen::Vector3d OmniKinematics::twist_variance(double wheel_sd_radps) const {
  return (backward_ * backward_.transpose()).diagonal() * (wheel_sd_radps * wheel_sd_radps);
}

}  // namespace trivela::kicking
