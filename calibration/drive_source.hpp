#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibration/robot_update.hpp"
#include "calibration/rows/recorded_drives.hpp"
#include "kicking/lob/lob_record.hpp"
#include "kicking/policy/policy.hpp"
#include "log/read/reader.hpp"

namespace trivela::calibration {

/// One match of a calibration.
struct DrivePlan {
  std::string name;  ///< of its files
  kicking::PolicyName policy{};
  std::optional<double> ball_to_goal_m{};  ///< where every possession begins; none: where the source says
  bool laser = false;                      ///< it records the lobs
  std::uint32_t possessions = 1;
  std::int64_t seed = 1;              ///< of what the source draws
  std::vector<std::string> settings;  ///< lines on top, e.g. "policy.test_drive.powers = [15.0]"
};

/// What was recorded.
struct DriveRecord {
  std::string log;    ///< path of the match log; in process the name that it would have
  std::string scans;  ///< of the scans; empty: the plan has no laser
  std::vector<log::Kick> kicks;
  RecordedDrives drives;
  std::vector<double> kicked_powers;          ///< of the kicks over the laser
  std::vector<kicking::lob::LobRecord> lobs;  ///< refused ones too
  double played_s = 0.0;
  double wall_s = 0.0;
};

/// Plays the matches of a calibration: on a field, or in the world that it was made with. The same plan with the same
/// robot gives the same records from every source of one world.
class DriveSource {
 public:
  virtual ~DriveSource() = default;
  virtual DriveRecord play(const DrivePlan& plan, const RobotUpdate& robot) = 0;
};

}  // namespace trivela::calibration
