#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibration/robot_update.hpp"
#include "calibration/rows/recorded_drives.hpp"
#include "config/scenario.hpp"
#include "evaluator/log/reader.hpp"
#include "kicking/lob/lob_record.hpp"
#include "kicking/policy/policy.hpp"

namespace trivela::calibration {

/// One match of a calibration in simulation.
struct DrivePlan {
  std::string name;  ///< of its files
  kicking::PolicyName policy{};
  sim::Scenario scenario;
  std::uint32_t possessions = 1;
  std::int64_t seed = 1;
  std::vector<std::string> settings;  ///< lines on top, e.g. "policy.test_drive.powers = [15.0]"
};

/// What was recorded.
struct DriveRecord {
  std::string log;    ///< path of the match log; in process the name that it would have
  std::string scans;  ///< of the scans; empty: the scenario has no laser
  std::vector<evaluator::log::Kick> kicks;
  RecordedDrives drives;
  std::vector<double> kicked_powers;          ///< of the kicks over the laser
  std::vector<kicking::lob::LobRecord> lobs;  ///< refused ones too
  double played_s = 0.0;
  double wall_s = 0.0;
};

/// Plays the matches of a calibration. The same plan with the same robot gives the same records from every source.
class DriveSource {
 public:
  virtual ~DriveSource() = default;
  virtual DriveRecord play(const DrivePlan& plan, const RobotUpdate& robot) = 0;
};

}  // namespace trivela::calibration
