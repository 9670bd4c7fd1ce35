#pragma once

#include <CLI/CLI.hpp>

#include "kicking/geometry/angle.hpp"
#include "kicking/lob/scan.hpp"

namespace trivela::cli {

/// Where the scanner stands, as a human measures it.
struct MountFlags {
  double laser_x_m = kicking::lob::LaserMount{}.x_m;
  double laser_z_m = kicking::lob::LaserMount{}.z_m;
  double front_elevation_deg = 90.0;
  bool mirrored = false;

  kicking::lob::LaserMount mount() const {
    return {laser_x_m, laser_z_m, kicking::radians(front_elevation_deg), mirrored};
  }
};

inline void add_mount_flags(CLI::App& verb, MountFlags& flags) {
  verb.add_option("--laser-x-m", flags.laser_x_m, "scanner, along the kick from the ball's centre at the launch")
      ->check(CLI::Range(-100.0, 100.0))
      ->capture_default_str();
  verb.add_option("--laser-z-m", flags.laser_z_m, "scanner, over the floor")
      ->check(CLI::Range(-10.0, 10.0))
      ->capture_default_str();
  verb.add_option("--front-elevation-deg", flags.front_elevation_deg,
                  "direction of the scanner's front: 0 along the kick, 90 upwards")
      ->check(CLI::Range(-360.0, 360.0))
      ->capture_default_str();
  verb.add_flag("--mirrored", flags.mirrored, "the scanner lies on its other side");
}

}  // namespace trivela::cli
