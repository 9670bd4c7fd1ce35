#pragma once

#include <cmath>
#include <optional>

#include "kicking/lob/scan.hpp"
#include "sim/truth.hpp"

namespace trivela::sim {

/// A scanning range finder beside the field whose scan plane stands upright. "Assumption": no publication gives it. No
/// public laser scan of a flying ball exists; the error model is put together from measurements of standing targets.
struct LaserModel {
  kicking::lob::ScanGeometry geometry{};  ///< UTM-30LX: SCIP 2.0 specification
  double x_m = 4.0;                       ///< in F
  double y_m = 0.0;                       ///< in F
  double z_m = 0.05;                      ///< over the floor; assumption: it lies on its side
  /// Horizontal direction in the scan plane that elevations are counted from, the kick's if all is well: a heading in
  /// F, 0 faces +y, counter-clockwise. Its unit vector is u = (-sin, cos); -90 degrees: u = +x.
  double heading_rad = -1.5707963267948966;
  double front_elevation_rad = 1.5707963267948966;  ///< as in LaserMount
  bool mirrored = false;                            ///< as in LaserMount
  double range_sd_m = 0.010;                        ///< white; UTM-30LX and URG-04LX: 4 to 16 mm measured at 1 to 4 m
  double dropout_ratio = 0.005;                     ///< beams without an answer; UTM-30LX recording: 0.7 % invalid
  double mixed_ratio = 0.3;    ///< a beam that just misses the ball reads something behind its edge; assumption
  double mixed_depth_m = 0.5;  ///< ... up to so much, or up to the background if that is nearer; assumption
  std::optional<double> wall_ahead_m = 12.0;  ///< upright wall along +u from the scanner; assumption
  std::optional<double> wall_behind_m;        ///< along -u
  std::optional<double> ceiling_m;            ///< over the floor
};

/// The pose as the analyzer has to know it, for kicks from `launch`: x along u from there.
inline kicking::lob::LaserMount mount_of(const LaserModel& laser, const Eigen::Vector3d& launch) {
  const double along_m =
      (laser.x_m - launch.x()) * -std::sin(laser.heading_rad) + (laser.y_m - launch.y()) * std::cos(laser.heading_rad);
  return {along_m, laser.z_m, laser.front_elevation_rad, laser.mirrored};
}

}  // namespace trivela::sim
