#include "robot/odometry/wheel_odometry.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {

std::optional<OdometryEstimate> WheelOdometry::update(std::int64_t t_ns, std::span<const double> wheel_radps,
                                                      const std::optional<double>& gyro_radps) {
  constexpr double kFastest_radps = 1e3;  // beyond any motor; what came of more would stay in the pose
  const auto sound = [](double w) { return std::abs(w) <= kFastest_radps; };
  const bool all_sound = std::all_of(wheel_radps.begin(), wheel_radps.end(), sound);
  if (!all_sound || wheel_radps.size() < static_cast<std::size_t>(kinematics_.wheel_count())) return std::nullopt;
  if (last_t_ns_ && t_ns <= *last_t_ns_) return std::nullopt;

  kicking::Twist twist = kinematics_.twist(wheel_radps);
  double var_omega = variance_.z();
  if (gyro_radps && sound(*gyro_radps)) {
    const double var_gyro = noise_.gyro_sd_radps * noise_.gyro_sd_radps;
    twist.omega_radps = (twist.omega_radps * var_gyro + *gyro_radps * var_omega) / (var_gyro + var_omega);
    var_omega = var_omega * var_gyro / (var_gyro + var_omega);
  }
  const kicking::Twist mean{0.5 * (estimate_.twist.vx_mps + twist.vx_mps),
                            0.5 * (estimate_.twist.vy_mps + twist.vy_mps),
                            0.5 * (estimate_.twist.omega_radps + twist.omega_radps)};
  estimate_.twist = twist;
  estimate_.var_v_m2ps2 = std::max(variance_.x(), variance_.y());
  estimate_.var_omega_rad2ps2 = var_omega;
  if (last_t_ns_) {
    const double dt_s = kicking::seconds(t_ns - *last_t_ns_);
    estimate_.pose = kicking::advance(estimate_.pose, mean, dt_s);
    const double path_m2 = (mean.vx_mps * mean.vx_mps + mean.vy_mps * mean.vy_mps) * dt_s * dt_s;
    const double turn_rad = mean.omega_radps * dt_s;
    estimate_.var_position_m2 +=
        noise_.drift_ratio * noise_.drift_ratio * path_m2 + estimate_.var_v_m2ps2 * dt_s * dt_s;
    estimate_.var_heading_rad2 += std::pow(noise_.heading_drift_ratio * turn_rad, 2) + var_omega * dt_s * dt_s;
  }
  last_t_ns_ = t_ns;
  return estimate_;
}

}  // namespace trivela::robot
