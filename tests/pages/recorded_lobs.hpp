#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>
#include <vector>

#include "kicking/geometry/angle.hpp"
#include "kicking/model/power_table.hpp"
#include "log/write/scan_log.hpp"
#include "sim/laser/record.hpp"
#include "tests/support/folder.hpp"

namespace trivela::pages {

/// A folder with a synthetic record of one lob of each power; goes with the object.
class RecordedLobs {
 public:
  explicit RecordedLobs(const std::vector<kicking::SetPoint>& kicks) {
    sim::LaserModel laser;
    sim::RecordPlan plan{.kicks = {}, .background_s = 1.2, .lie_s = 0.4, .fly_s = 1.8, .pause_s = 0.3};
    for (const kicking::SetPoint& kick : kicks) {
      plan.kicks.push_back({.exit_speed_mps = kick.speed_mps,
                            .exit_angle_rad = kicking::radians(36.78),
                            .drag_coefficient = 0.25,
                            .power = kick.power});
    }
    made_ = sim::synthesize_record(laser, plan, {}, 1);
    session_.identity = {"synthetic", "utm-30lx", "seed 1", "", "none"};
    session_.geometry = laser.geometry;
    session_.mount = made_.mount;
    session_.simulated = true;
    session_.source = "synthetic, seed 1";
    log::ScanWriter writer(path(), session_);
    for (const sim::KickedTruth& truth : made_.truth) {
      writer.set_point({.t_ns = truth.launch_t_ns - 300'000'000, .power = *truth.kick.power, .kick_id = 0});
    }
    for (const kicking::lob::Scan& scan : made_.scans) writer.push(scan);
    writer.finalise();
  }

  std::filesystem::path path(const std::string& name = "lobs.db") const { return folder_ / name; }
  const std::vector<kicking::lob::Scan>& scans() const { return made_.scans; }
  const log::ScanSession& session() const { return session_; }

 private:
  tests::Folder folder_;
  sim::SyntheticRecord made_;
  log::ScanSession session_;
};

}  // namespace trivela::pages
