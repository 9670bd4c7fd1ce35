#include "robot/odometry/wheel_odometry.hpp"

#include "idl/none.hpp"

namespace trivela::robot {

msg::Odometry odometry_message(const hal::WheelSample& sample, const OdometryEstimate& estimate) {
  const auto wheel = [&](int i) {
    return i < sample.wheel_count ? sample.wheel_radps[static_cast<std::size_t>(i)] : msg::kNone;
  };
  msg::Odometry out{};
  out.t_ns = sample.t_ns;
  out.wheel_0_radps = wheel(0);
  out.wheel_1_radps = wheel(1);
  out.wheel_2_radps = wheel(2);
  out.wheel_3_radps = wheel(3);
  out.gyro_radps = sample.gyro_radps.value_or(msg::kNone);
  out.vx_mps = estimate.twist.vx_mps;
  out.vy_mps = estimate.twist.vy_mps;
  out.omega_radps = estimate.twist.omega_radps;
  out.x_m = estimate.pose.x_m;
  out.y_m = estimate.pose.y_m;
  out.heading_rad = kicking::wrap_angle(estimate.pose.heading_rad);
  out.var_v_m2ps2 = estimate.var_v_m2ps2;
  out.var_omega_rad2ps2 = estimate.var_omega_rad2ps2;
  out.var_position_m2 = estimate.var_position_m2;
  out.var_heading_rad2 = estimate.var_heading_rad2;
  return out;
}

}  // namespace trivela::robot
