#include "robot/odometry/wheel_odometry.hpp"

#include <cmath>
#include <iterator>
#include <span>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

constexpr double msg::Odometry::*kWheels[]{&msg::Odometry::wheel_0_radps, &msg::Odometry::wheel_1_radps,
                                           &msg::Odometry::wheel_2_radps, &msg::Odometry::wheel_3_radps};

}  // namespace

const msg::Odometry* WheelOdometry::update(const hal::WheelSample& sample) {
  constexpr double kFastest_radps = 1e3;  // beyond any motor; what came of more would stay in the pose
  const auto healthy = [](double w) { return std::abs(w) <= kFastest_radps; };
  const std::span wheel_radps{sample.wheel_radps.data(), static_cast<std::size_t>(sample.wheel_count)};
  const bool all_healthy = std::all_of(wheel_radps.begin(), wheel_radps.end(), healthy);
  if (!all_healthy || sample.wheel_count < kinematics_.wheel_count()) return nullptr;
  if (last_t_ns_ && sample.t_ns <= *last_t_ns_) return nullptr;

  kicking::Twist twist = kinematics_.twist(wheel_radps);
  double var_omega = variance_.z();
  if (sample.gyro_radps && healthy(*sample.gyro_radps)) {
    const double var_gyro = noise_.gyro_sd_radps * noise_.gyro_sd_radps;
    twist.omega_radps = (twist.omega_radps * var_gyro + *sample.gyro_radps * var_omega) / (var_gyro + var_omega);
    var_omega = var_omega * var_gyro / (var_gyro + var_omega);
  }
  const kicking::Twist mean{0.5 * (now_.vx_mps + twist.vx_mps), 0.5 * (now_.vy_mps + twist.vy_mps),
                            0.5 * (now_.omega_radps + twist.omega_radps)};
  if (last_t_ns_) {
    const double dt_s = kicking::seconds(sample.t_ns - *last_t_ns_);
    pose_ = kicking::advance(pose_, mean, dt_s);
    const double path_m2 = (mean.vx_mps * mean.vx_mps + mean.vy_mps * mean.vy_mps) * dt_s * dt_s;
    const double turn_rad = mean.omega_radps * dt_s;
    now_.var_position_m2 += noise_.drift_ratio * noise_.drift_ratio * path_m2 + var_v_m2ps2() * dt_s * dt_s;
    now_.var_heading_rad2 += std::pow(noise_.heading_drift_ratio * turn_rad, 2) + var_omega * dt_s * dt_s;
  }
  now_.t_ns = sample.t_ns;
  last_t_ns_ = sample.t_ns;
  for (std::size_t i = 0; i < std::size(kWheels); ++i)
    now_.*kWheels[i] = i < wheel_radps.size() ? wheel_radps[i] : msg::kNone;
  now_.gyro_radps = sample.gyro_radps.to_message();
  now_.vx_mps = twist.vx_mps;
  now_.vy_mps = twist.vy_mps;
  now_.omega_radps = twist.omega_radps;
  now_.x_m = pose_.x_m;
  now_.y_m = pose_.y_m;
  now_.heading_rad = kicking::wrap_angle(pose_.heading_rad);
  now_.var_v_m2ps2 = var_v_m2ps2();
  now_.var_omega_rad2ps2 = var_omega;
  return &now_;
}

}  // namespace trivela::robot
