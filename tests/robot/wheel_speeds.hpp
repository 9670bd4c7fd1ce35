#pragma once

#include <cmath>
#include <vector>

#include "kicking/geometry/frames.hpp"
#include "kicking/model/omni_kinematics.hpp"

namespace trivela::robot {

/// Wheel speeds that give `twist` [rad/s], by the equation of OmniKinematics.
inline std::vector<double> wheel_speeds_radps(const kicking::WheelBase& base, const kicking::Twist& twist) {
  std::vector<double> speeds;
  for (const double angle : base.wheel_angles_rad) {
    speeds.push_back(
        (-std::sin(angle) * twist.vx_mps + std::cos(angle) * twist.vy_mps + base.wheel_distance_m * twist.omega_radps) /
        base.wheel_radius_m);
  }
  return speeds;
}

}  // namespace trivela::robot
