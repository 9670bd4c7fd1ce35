#include "sim/laser/laser_model.hpp"

#include <cmath>

namespace trivela::sim {

kicking::lob::LaserMount mount_of(const LaserModel& laser, const Eigen::Vector3d& launch) {
  const double along_m =
      (laser.x_m - launch.x()) * -std::sin(laser.heading_rad) + (laser.y_m - launch.y()) * std::cos(laser.heading_rad);
  return {along_m, laser.z_m, laser.front_elevation_rad, laser.mirrored};
}

}  // namespace trivela::sim
