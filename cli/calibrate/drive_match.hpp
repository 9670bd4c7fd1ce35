#pragma once

#include <filesystem>

#include "calibration/drive_source.hpp"
#include "cli/launch/signals.hpp"
#include "config/settings.hpp"
#include "sim/scenario.hpp"

namespace trivela::cli {

/// The files of a drive in the folder, by their names; nothing is read.
calibration::DriveRecord drive_files(const std::filesystem::path& folder, const calibration::DrivePlan& plan);

/// Takes what the drive's log and scans hold into its record.
void read_back(calibration::DriveRecord& record);

/// Plays matches in lockstep through the real nodes, one after another; each leaves NAME.db, with a laser
/// NAME.scans.db, and the scenario that it played, NAME.scenario.toml, in one folder.
class DriveMatches : public calibration::DriveSource {
 public:
  /// `world` and `settings`: what all matches have in common. `robot_file`: where the nodes find the robot, written
  /// before each match. `signals` outlives it.
  DriveMatches(sim::Scenario world, config::Settings settings, std::filesystem::path folder,
               std::filesystem::path robot_file, SignalInbox& signals);

  /// Throws UsageError where a file of that name exists, std::runtime_error where somebody asked to stop, a node died
  /// or rows were lost, with what is left on the disk.
  calibration::DriveRecord play(const calibration::DrivePlan& plan, const calibration::RobotUpdate& robot) override;

 private:
  sim::Scenario world_;
  config::Settings settings_;
  std::filesystem::path folder_;
  std::filesystem::path robot_file_;
  SignalInbox& signals_;
};

}  // namespace trivela::cli
