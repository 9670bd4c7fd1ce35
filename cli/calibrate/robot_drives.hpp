#pragma once

#include <filesystem>

#include "calibration/drive_source.hpp"
#include "cli/launch/signals.hpp"
#include "config/settings.hpp"

namespace trivela::cli {

/// Plays drives on a robot, in real time: its nodes with the devices of its configuration, on the configuration's bus.
/// Vision and the goal camera are somebody else's. Where nobody writes `referee`, a referee box of this process does:
/// it says START when all nodes run and STOP at the drive's end, at Ctrl-C and when this process is gone. A drive ends
/// when it has gone through its list, or with the last of its plan's kicks.
class RobotDrives : public calibration::DriveSource {
 public:
  /// `settings`: of the robot. `robot_file`: where the nodes find it, written before each drive. `signals` outlives it.
  RobotDrives(config::Settings settings, std::filesystem::path folder, std::filesystem::path robot_file,
              SignalInbox& signals);

  /// Throws std::runtime_error where nodes of this robot run already, nobody says what the drive is measured by,
  /// somebody asked to stop, a node died or rows were lost, with what is left on the disk.
  calibration::DriveRecord play(const calibration::DrivePlan& plan, const calibration::RobotUpdate& robot) override;

 private:
  config::Settings settings_;
  std::filesystem::path folder_;
  std::filesystem::path robot_file_;
  SignalInbox& signals_;
};

}  // namespace trivela::cli
