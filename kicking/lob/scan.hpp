#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace trivela::kicking::lob {

/// Who measured: what a SCIP scanner answers to VV and PP, or "synthetic".
struct ScannerIdentity {
  std::string vendor;
  std::string product;
  std::string serial;
  std::string firmware;
  std::string protocol;
};

/// VEND of a scanner that is a program (trivela scan --emulate).
inline constexpr char kEmulatedVendor[] = "Trivela";

inline bool is_emulated(const ScannerIdentity& scanner) { return scanner.vendor == kEmulatedVendor; }

/// When and where the beams of a scan look. Beam i has the angle first_angle_rad + i step_rad in the scanner's own
/// plane (counter-clockwise, 0 = its front) and is measured at the scan's t_ns + i beam_period_s.
struct ScanGeometry {
  std::size_t beams = 1081;
  double first_angle_rad = -2.356194490192345;  ///< UTM-30LX: step 0 at -135 degrees
  double step_rad = 0.004363323129985824;       ///< 0.25 degrees, 1440 steps a revolution
  double beam_period_s = 0.025 / 1440.0;        ///< revolution / steps of a revolution
  double scan_period_s = 0.025;                 ///< start of one scan to start of the next
  double min_range_m = 0.1;
  double max_range_m = 30.0;
};

/// One revolution of the scanner: t_ns is the instant of beam 0. Ranges in millimetres as the device gives them; below
/// kFirstRange_mm they are error codes: no return.
struct Scan {
  std::int64_t t_ns = 0;
  std::vector<std::uint32_t> range_mm;
};

/// SCIP 2.0: smaller values are error codes.
inline constexpr std::uint32_t kFirstRange_mm = 20;

/// Where the scanner stands in the plane of the kick: x along the kick from the ball's centre at the launch, z over the
/// floor. A beam of scanner angle a looks along elevation = front_elevation_rad + a (or - a when mirrored), counted
/// from +x over +z.
struct LaserMount {
  double x_m = 4.0;
  double z_m = 0.05;
  double front_elevation_rad = 1.5707963267948966;  ///< the scanner's front looks straight up
  bool mirrored = false;                            ///< the scanner lies on its other side
};

}  // namespace trivela::kicking::lob
