#include "robot/odometry/wheel_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "idl/none.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::robot {

std::optional<msg::Odometry> WheelOdometry::update(const hal::WheelSample& sample) {
  constexpr double kFastest_radps = 1e3;  // beyond any motor; what came of more would stay in the pose
  const auto sound = [](double w) { return std::abs(w) <= kFastest_radps; };
  const std::span wheel_radps{sample.wheel_radps.data(), static_cast<std::size_t>(sample.wheel_count)};
  const bool all_sound = std::all_of(wheel_radps.begin(), wheel_radps.end(), sound);
  if (!all_sound || sample.wheel_count < kinematics_.wheel_count()) return std::nullopt;
  if (last_t_ns_ && sample.t_ns <= *last_t_ns_) return std::nullopt;

  kicking::Twist twist = kinematics_.twist(wheel_radps);
  double var_omega = variance_.z();
  if (sample.gyro_radps && sound(*sample.gyro_radps)) {
    const double var_gyro = noise_.gyro_sd_radps * noise_.gyro_sd_radps;
    twist.omega_radps = (twist.omega_radps * var_gyro + *sample.gyro_radps * var_omega) / (var_gyro + var_omega);
    var_omega = var_omega * var_gyro / (var_gyro + var_omega);
  }
  const kicking::Twist mean{0.5 * (twist_.vx_mps + twist.vx_mps), 0.5 * (twist_.vy_mps + twist.vy_mps),
                            0.5 * (twist_.omega_radps + twist.omega_radps)};
  twist_ = twist;
  if (last_t_ns_) {
    const double dt_s = kicking::seconds(sample.t_ns - *last_t_ns_);
    pose_ = kicking::advance(pose_, mean, dt_s);
    const double path_m2 = (mean.vx_mps * mean.vx_mps + mean.vy_mps * mean.vy_mps) * dt_s * dt_s;
    const double turn_rad = mean.omega_radps * dt_s;
    var_position_m2_ += noise_.drift_ratio * noise_.drift_ratio * path_m2 + var_v_m2ps2() * dt_s * dt_s;
    var_heading_rad2_ += std::pow(noise_.heading_drift_ratio * turn_rad, 2) + var_omega * dt_s * dt_s;
  }
  last_t_ns_ = sample.t_ns;
  return message(sample, var_omega);
}

msg::Odometry WheelOdometry::message(const hal::WheelSample& sample, double var_omega_rad2ps2) const {
  const auto wheel = [&](int i) {
    return i < sample.wheel_count ? sample.wheel_radps[static_cast<std::size_t>(i)] : msg::kNone;
  };
  msg::Odometry out{};
  out.t_ns = sample.t_ns;
  out.wheel_0_radps = wheel(0);
  out.wheel_1_radps = wheel(1);
  out.wheel_2_radps = wheel(2);
  out.wheel_3_radps = wheel(3);
  out.gyro_radps = msg::wire_of(sample.gyro_radps);
  out.vx_mps = twist_.vx_mps;
  out.vy_mps = twist_.vy_mps;
  out.omega_radps = twist_.omega_radps;
  out.x_m = pose_.x_m;
  out.y_m = pose_.y_m;
  out.heading_rad = kicking::wrap_angle(pose_.heading_rad);
  out.var_v_m2ps2 = var_v_m2ps2();
  out.var_omega_rad2ps2 = var_omega_rad2ps2;
  out.var_position_m2 = var_position_m2_;
  out.var_heading_rad2 = var_heading_rad2_;
  return out;
}

}  // namespace trivela::robot
