#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kicking/geometry/angle.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/lob/analyzer.hpp"
#include "sim/laser/record.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::tests {

/// The returns of a vector file.
inline std::vector<kicking::lob::ForegroundReturn> returns_of(const std::string& file) {
  std::vector<kicking::lob::ForegroundReturn> returns;
  for (const auto& row : rows(file)) {
    returns.push_back({std::stoll(row.text("scan")), kicking::nanoseconds(row.number("t_scan_start_s")),
                       kicking::nanoseconds(row.number("t_beam_s")), kicking::radians(row.number("angle_deg")),
                       row.number("range_m")});
  }
  return returns;
}

/// An URG-04LX as the vectors have it: 0.3516 degrees a step, 10 scans a second.
inline kicking::lob::ScanGeometry urg_04lx() {
  kicking::lob::ScanGeometry urg;
  urg.beams = 682;
  urg.step_rad = kicking::radians(0.3515625);
  urg.first_angle_rad = -340 * urg.step_rad;
  urg.beam_period_s = 0.1 / 1024.0;
  urg.scan_period_s = 0.1;
  urg.min_range_m = 0.02;
  urg.max_range_m = 5.6;
  return urg;
}

inline sim::SyntheticKick kick(double speed_mps, double angle_deg, double drag_coefficient = 0.25) {
  return {speed_mps, kicking::radians(angle_deg), drag_coefficient, std::nullopt};
}

/// The lobs that an analyzer finds in scans.
inline std::vector<kicking::lob::LobRecord> lobs_in(const std::vector<kicking::lob::Scan>& scans,
                                                    const kicking::lob::ScanGeometry& geometry,
                                                    const kicking::lob::LaserMount& mount,
                                                    const kicking::lob::AnalyzerConfig& config = {}) {
  kicking::lob::Analyzer analyzer(geometry, mount, config);
  std::vector<kicking::lob::LobRecord> lobs;
  for (const auto& scan : scans) {
    if (auto lob = analyzer.add(scan)) lobs.push_back(std::move(*lob));
  }
  if (auto lob = analyzer.finish()) lobs.push_back(std::move(*lob));
  return lobs;
}

/// Synthesizes a record and analyses it.
inline std::vector<kicking::lob::LobRecord> lobs_of(const sim::LaserModel& laser, const sim::RecordPlan& plan,
                                                    std::uint64_t seed = 1,
                                                    const kicking::lob::AnalyzerConfig& config = {}) {
  const auto record = sim::synthesize_record(laser, plan, {}, seed);
  return lobs_in(record.scans, laser.geometry, record.mount, config);
}

}  // namespace trivela::tests
