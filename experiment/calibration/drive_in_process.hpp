#pragma once

#include "calibration/drive_source.hpp"
#include "config/settings.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

/// The world as it is for the plan.
sim::Scenario scenario_of(const calibration::DrivePlan& plan, sim::Scenario world);

/// Plays the drives in this process (experiment/play): no bus, no child process, no file.
class DrivesInProcess : public calibration::DriveSource {
 public:
  /// `world` and `settings`: what all matches have in common.
  DrivesInProcess(sim::Scenario world, config::Settings settings)
      : world_(std::move(world)), settings_(std::move(settings)) {}

  /// Throws std::runtime_error as check_playable().
  calibration::DriveRecord play(const calibration::DrivePlan& plan, const calibration::RobotUpdate& robot) override;

 private:
  sim::Scenario world_;
  config::Settings settings_;
};

}  // namespace trivela::experiment
