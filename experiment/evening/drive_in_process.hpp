#pragma once

#include "calibration/drive_source.hpp"
#include "config/settings.hpp"

namespace trivela::experiment {

/// Plays the drives in this process (nodes/in_process): no bus, no child process, no file.
class DrivesInProcess : public calibration::DriveSource {
 public:
  /// `settings`: what all matches have in common.
  explicit DrivesInProcess(config::Settings settings) : settings_(std::move(settings)) {}

  /// Throws std::runtime_error as check_playable().
  calibration::DriveRecord play(const calibration::DrivePlan& plan, const calibration::RobotUpdate& robot) override;

 private:
  config::Settings settings_;
};

}  // namespace trivela::experiment
