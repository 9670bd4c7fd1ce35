#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/verbs.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/lob/scan.hpp"
#include "log/write/scan_log.hpp"
#include "sim/laser/record.hpp"

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
  add_default(verb, "--laser-x-m", flags.laser_x_m, "scanner, along the kick from the ball's centre at the launch",
              CLI::Range(-100.0, 100.0));
  add_default(verb, "--laser-z-m", flags.laser_z_m, "scanner, over the floor", CLI::Range(-10.0, 10.0));
  add_default(verb, "--front-elevation-deg", flags.front_elevation_deg,
              "direction of the scanner's front: 0 along the kick, 90 upwards", CLI::Range(-360.0, 360.0));
  verb.add_flag("--mirrored", flags.mirrored, "the scanner lies on its other side");
}

/// Stands wherever synthetic scans are made or shown.
inline constexpr char kSyntheticNotice[] = "synthetic scans: no public laser scan of a flying ball exists";

/// What the kicks of a synthetic record are, and how well the scanner sees.
struct SyntheticFlags {
  std::uint64_t seed = 1;
  int lobs = 2;  ///< of each speed
  std::vector<double> exit_speed_mps;
  std::string set_points;  ///< robot file; empty: exit_speed_mps
  double exit_angle_deg = 36.78;
  double cd = 0.25;
  double speed_sd_mps = 0.0;
  double angle_sd_deg = 0.0;
  double range_sd_m = sim::LaserModel{}.range_sd_m;
  double dropout_ratio = sim::LaserModel{}.dropout_ratio;
  double mixed_ratio = sim::LaserModel{}.mixed_ratio;
  std::string scanner = "utm-30lx";  ///< or "urg-04lx"
};

/// A synthetic record and what it says about itself.
struct SyntheticScans {
  log::ScanSession session;
  sim::SyntheticRecord record;
};

/// Throws UsageError for flags that make no sense together, config::Error for a robot file that cannot be read.
SyntheticScans synthesize(const SyntheticFlags& flags, const MountFlags& mount);

/// Each is one mode of `trivela scan` and returns its exit code.
int write_synthetic(const SyntheticScans& scans, const std::filesystem::path& out, const std::string& truth_csv);
int record_scans(const std::filesystem::path& out, const std::string& device, const MountFlags& mount,
                 std::optional<double> seconds, std::optional<double> power);

struct EmulateFlags {
  std::string source;           ///< scan record, or "synthetic"
  std::optional<int> tcp_port;  ///< none: a pseudo-terminal
  double speed = 1.0;
  bool loop = false;
};
int emulate_scanner(const EmulateFlags& flags, const SyntheticFlags& synthetic, const MountFlags& mount);
int show_scan_info(const std::filesystem::path& record, bool json);

}  // namespace trivela::cli
