#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "calibration/calibration_run.hpp"
#include "config/text/installation.hpp"
#include "experiment/calibration/calibration_check.hpp"

namespace trivela::cli {

struct RunFlags {
  std::string in;  ///< "simulation", "field"
  std::string robot = "simulated";
  std::string start = config::shipped("robots/uncalibrated.toml").string();
  std::string scenario = config::shipped("scenarios/calibration.toml").string();
  std::string check = config::shipped("scenarios/noise_free.toml").string();
  std::string config = config::shipped("default.toml").string();
  std::string team;          ///< scenario of the matches
  std::uint32_t number = 1;  ///< whose kicker it is
  std::string out_dir = "calibration";
  std::string out;
  std::string log_level = "warn";
  std::int64_t seed = 1;
  calibration::CalibrationEffort effort;
  std::vector<std::string> overrides;  ///< field: settings on top
  bool rehearse = false;               ///< field: in the simulated world of the scenario
  bool in_process = false;
  bool json = false;
};

/// Where the robot's file can be written and is not yet. Makes --out-dir. Throws UsageError where it exists.
std::filesystem::path place_of(const RunFlags& flags);

/// The check with the finished robot.
calibration::DrivePlan check_plan(const RunFlags& flags, bool laser);

/// Does the calibration hold what it is held to? If not, says so.
bool passes_gate(const experiment::AimErrors& observed);

/// --in field: the same calibration on a robot, asking a person for each step. Returns the exit code.
int calibrate_in_field(const RunFlags& flags);

}  // namespace trivela::cli
