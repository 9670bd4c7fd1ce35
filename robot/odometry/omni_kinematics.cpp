#include "robot/odometry/omni_kinematics.hpp"

#include <fmt/core.h>

#include <Eigen/QR>
#include <cassert>
#include <cmath>
#include <stdexcept>

namespace trivela::robot {

OmniKinematics::OmniKinematics(const config::WheelBase& base) {
  const auto count = static_cast<Eigen::Index>(base.wheel_angles_rad.size());
  if (count != 3 && count != 4)
    throw std::invalid_argument{fmt::format("an omni base has 3 or 4 wheels, not {}", count)};
  if (!(base.wheel_radius_m > 0.0) || !(base.wheel_distance_m > 0.0)) {
    throw std::invalid_argument{fmt::format("wheel radius {} m and distance {} m must be positive", base.wheel_radius_m,
                                            base.wheel_distance_m)};
  }
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

kicking::Twist OmniKinematics::twist(std::span<const double> wheel_radps) const {
  assert(wheel_radps.size() >= static_cast<std::size_t>(forward_.rows()));
  const Eigen::Map<const Eigen::VectorXd> speeds{wheel_radps.data(), forward_.rows()};
  const Eigen::Vector3d v = backward_ * speeds;
  return {v.x(), v.y(), v.z()};
}

std::vector<double> OmniKinematics::wheel_speeds_radps(const kicking::Twist& twist) const {
  const Eigen::VectorXd speeds = forward_ * Eigen::Vector3d{twist.vx_mps, twist.vy_mps, twist.omega_radps};
  return {speeds.begin(), speeds.end()};
}

Eigen::Vector3d OmniKinematics::twist_variance(double wheel_sd_radps) const {
  return (backward_ * backward_.transpose()).diagonal() * (wheel_sd_radps * wheel_sd_radps);
}

}  // namespace trivela::robot
