#include "experiment/calibration/simulated_calibration.hpp"

#include <fmt/core.h>

#include <optional>

#include "config/scenario/scenario.hpp"
#include "config/text/installation.hpp"
#include "experiment/calibration/drive_in_process.hpp"
#include "experiment/run/in_threads.hpp"
#include "sim/kicker/kicker.hpp"

namespace trivela::experiment {

SimulatedCalibrationOptions default_simulated_calibration() {
  return {.scenario = config::load_scenario(config::shipped("scenarios/calibration.toml")),
          .settings = config::load_settings(config::shipped("default.toml")),
          .start = config::load_robot(config::shipped("robots/uncalibrated.toml"))};
}

void add_guessed_kinds(config::Robot& robot) {
  const config::Robot guess = config::load_robot(config::shipped("robots/lob_flat_1.toml"));
  robot.kinds = guess.kinds;
  robot.model.lever_s = guess.model.lever_s;
  robot.model.further_kinds = guess.model.further_kinds;
}

sim::Scenario calibration_scenario(const sim::Scenario& calibration, const sim::Scenario& world, std::uint32_t number) {
  sim::Scenario scenario = world;
  scenario.kicker = sim::team_kicker(world, number);
  scenario.kicker.drift_sd_ratio = 0.0;  // the day begins with it
  scenario.team = calibration.team;
  scenario.possession = calibration.possession;
  scenario.opponent = calibration.opponent;
  scenario.keeper = calibration.keeper;
  scenario.referee = calibration.referee;
  scenario.laser = calibration.laser;
  return scenario;
}

config::Settings calibration_settings(config::Settings settings) {
  settings.kick_decision.shadows = false;
  // The check aims at a height and stands for it, whatever the stopped policy plays by.
  kicking::PolicyConfig& policy = settings.policy;
  policy.height_law = kicking::HeightLaw::kExact;
  policy.aim_tolerance_rad = policy.test_drive.aim_tolerance_rad;
  policy.settle_s = policy.test_drive.settle_s;
  policy.rest_speed_mps = policy.test_drive.rest_speed_mps;
  policy.rest_turn_rate_radps = policy.test_drive.rest_turn_rate_radps;
  return settings;
}

config::Settings calibration_settings(config::Settings settings, const sim::Scenario& scenario) {
  settings = calibration_settings(std::move(settings));
  settings.run.cycle_s = settings.policy.cycle_s = scenario.cycle_s;
  const double ball_y_m = scenario.field.goal_line_y_m - scenario.possession.goal_distance_max_m;
  settings.scan_recorder.mount_x_m = scenario.laser.y_m - ball_y_m;
  settings.scan_recorder.mount_z_m = scenario.laser.z_m;
  settings.scan_recorder.mount_front_elevation_rad = scenario.laser.front_elevation_rad;
  return settings;
}

SimulatedCalibration play_calibration(const SimulatedCalibrationOptions& options, calibration::DriveSource& source,
                                      const std::function<void(const calibration::DriveSummary&)>& said) {
  config::Robot robot = options.start;
  robot.name = options.name;
  robot.source =
      fmt::format("simulated: trivela calibrate run --in simulation; what [calibration] does not name comes from: {}",
                  robot.source);
  robot.calibration.reset();
  const std::string command = fmt::format("trivela calibrate run --in simulation --robot {} --seed {}{}", options.name,
                                          options.seed, options.flags);
  calibration::CalibrationRun run{source,
                                  options.scenario.possession.goal_distance_max_m,
                                  calibration_settings(options.settings, options.scenario),
                                  options.effort,
                                  options.seed * 100,
                                  calibration::RobotUpdate{robot, command, options.date}};
  std::vector<calibration::DriveSummary> drives = run.calibration(said);
  return {run.robot(), std::move(drives)};
}

SimulatedCalibration play_calibration(const SimulatedCalibrationOptions& options) {
  DrivesInProcess source{options.scenario, calibration_settings(options.settings, options.scenario)};
  return play_calibration(options, source);
}

config::Robot calibrated_robot(const sim::Scenario& world, std::int64_t seed, std::uint32_t number) {
  SimulatedCalibrationOptions options = default_simulated_calibration();
  options.scenario = calibration_scenario(options.scenario, world, number);
  options.seed = seed;
  options.name = fmt::format("calibration_{}", seed);
  if (world.kicker.flat.enabled) add_guessed_kinds(options.start);
  return play_calibration(options).robot.robot();
}

std::vector<SimulatedCalibration> play_calibrations(const SimulatedCalibrationOptions& options, std::size_t count,
                                                    std::size_t jobs,
                                                    const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<std::optional<SimulatedCalibration>> calibrations(count);
  in_threads(
      count, jobs,
      [&](std::size_t i) {
        SimulatedCalibrationOptions of_one = options;
        of_one.seed += static_cast<std::int64_t>(i);
        of_one.name = fmt::format("{}_{}", options.name, of_one.seed);
        calibrations[i] = play_calibration(of_one);
      },
      progress);
  std::vector<SimulatedCalibration> played;
  played.reserve(count);
  for (std::optional<SimulatedCalibration>& calibration : calibrations) played.push_back(std::move(*calibration));
  return played;
}

}  // namespace trivela::experiment
