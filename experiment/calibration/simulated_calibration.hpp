#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "calibration/calibration_run.hpp"
#include "calibration/drive_source.hpp"
#include "config/robot.hpp"
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

/// A calibration in simulation: which world, which robot, how much.
struct SimulatedCalibrationOptions {
  sim::Scenario scenario;     ///< world and places of the drives, e.g. calibration_scenario()
  config::Settings settings;  ///< of the nodes
  config::Robot start;        ///< uncalibrated; what no drive measures is kept
  std::string name = "simulated";
  std::int64_t seed = 1;  ///< 0 to 1e6; every draw of the calibration depends on it alone
  calibration::CalibrationEffort effort{};
  std::string flags{};  ///< of the command that makes this calibration again, beside --robot and --seed: " --team ..."
  std::string date{};   ///< ISO 8601, of its figures
};

struct SimulatedCalibration {
  calibration::RobotUpdate robot;  ///< with the figures, and what changed
  std::vector<calibration::DriveSummary> drives;
};

/// config/default.toml, config/robots/uncalibrated.toml and config/scenarios/calibration.toml.
SimulatedCalibrationOptions default_simulated_calibration();

/// The further kinds of kick of config/robots/lob_flat_1.toml, as guessed there.
void add_guessed_kinds(config::Robot& robot);

/// The calibration before a match in `world`: `calibration` (who stands where, an empty field, the laser) with the
/// field, ball, base, sensors and kicker of `world`; the kicker as fast as that of its robot `number` (from 1), before
/// the day drifts.
sim::Scenario calibration_scenario(const sim::Scenario& calibration, const sim::Scenario& world,
                                   std::uint32_t number = 1);

/// The settings that all drives share, on a field too: no shadows, and a check that stands and aims as the drives do.
config::Settings calibration_settings(config::Settings settings);

/// The same in a world, by its cycle. The scanner's place beside the field is measured with a tape: it
/// is the operator's knowledge.
config::Settings calibration_settings(config::Settings settings, const sim::Scenario& scenario);

/// Plays the drives through `source` and fits. `said` gets each drive as it ends. Throws what the source throws, and
/// std::runtime_error where there are too few kicks for a figure.
SimulatedCalibration play_calibration(const SimulatedCalibrationOptions& options, calibration::DriveSource& source,
                                      const std::function<void(const calibration::DriveSummary&)>& said = {});

/// The same in this process, without bus, child process or file; the robot that `trivela calibrate run` makes with this
/// seed. For any number of threads.
SimulatedCalibration play_calibration(const SimulatedCalibrationOptions& options);

/// The robot of a calibration of this world for an experiment: seed alone decides. Where the world's kicker has a flat
/// kick the robot has one too, which the calibration begins with as config/robots/lob_flat_1.toml guesses it.
config::Robot calibrated_robot(const sim::Scenario& world, std::int64_t seed, std::uint32_t number = 1);

/// Calibrations with the seeds options.seed, options.seed + 1, ..., played by `jobs` threads. `progress`: calibrations
/// that were played, of how many; called by one thread at a time.
std::vector<SimulatedCalibration> play_calibrations(
    const SimulatedCalibrationOptions& options, std::size_t count, std::size_t jobs,
    const std::function<void(std::size_t done, std::size_t all)>& progress = [](auto, auto) {});

}  // namespace trivela::experiment
