#pragma once

#include "cli/calibrate/drive_source.hpp"
#include "config/settings.hpp"

namespace trivela::cli {

/// Plays the drives in this process (nodes/in_process): no bus, no child process, no file.
class DrivesInProcess : public DriveSource {
 public:
  /// `settings`: what all matches have in common.
  explicit DrivesInProcess(config::Settings settings) : settings_(std::move(settings)) {}

  /// Throws std::runtime_error as nodes::check_playable().
  DriveRecord play(const DrivePlan& plan, const RobotUpdate& robot) override;

 private:
  config::Settings settings_;
};

}  // namespace trivela::cli
