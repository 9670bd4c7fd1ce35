#pragma once

#include "log/write/scan_log.hpp"
#include "tests/evaluator/log_fixture.hpp"

namespace trivela::evaluator {

/// Records of a small scanner, whose scan of a number is known.
class ScanTest : public LogTest {
 protected:
  static constexpr std::int64_t kPeriod_ns = 25'000'000;

  static log::ScanSession scan_session() {
    log::ScanSession session;
    session.identity = {"vendor", "product", "H0001", "1.2", "SCIP 2.0"};
    session.geometry = {.beams = 7,
                        .first_angle_rad = -0.5,
                        .step_rad = 0.1,
                        .beam_period_s = 0.001,
                        .scan_period_s = 0.025,
                        .min_range_m = 0.02,
                        .max_range_m = 5.6};
    session.mount = {.x_m = 3.5, .z_m = 0.25, .front_elevation_rad = 0.75, .mirrored = true};
    session.started_t_ns = 1000;
    session.realtime_offset_ns = -5;
    session.simulated = true;
    session.source = "synthetic, seed 1";
    session.software_version = "test";
    return session;
  }

  static kicking::lob::Scan scan(std::int64_t n) {
    kicking::lob::Scan scan{.t_ns = 1000 + n * kPeriod_ns, .range_mm = {}};
    for (std::int64_t beam = 0; beam < 7; ++beam)
      scan.range_mm.push_back(static_cast<std::uint32_t>(n * 131 + beam * n));
    return scan;
  }

  void write_record(std::int64_t scans, const std::string& name = "scans.db") {
    log::ScanWriter writer(path(name), scan_session(), options());
    for (std::int64_t n = 0; n < scans; ++n) writer.push(scan(n));
    writer.finalise();
  }

  std::string message_of_opening(const std::string& name = "scans.db") const {
    try {
      const log::ScanReader reader(path(name));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
};

}  // namespace trivela::evaluator
