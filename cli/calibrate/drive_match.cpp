#include "cli/calibrate/drive_match.hpp"

#include <fmt/core.h>

#include <utility>

#include "calibration/rows/lobs_of_scans.hpp"
#include "cli/launch/child_process.hpp"
#include "cli/launch/log_claim.hpp"
#include "cli/launch/match_run.hpp"
#include "cli/launch/record_match.hpp"
#include "cli/options/output.hpp"
#include "config/field.hpp"
#include "config/scenario/scenario.hpp"
#include "experiment/calibration/simulated_calibration.hpp"
#include "log/write/scan_log.hpp"

namespace trivela::cli {

namespace fs = std::filesystem;

namespace {

constexpr double kLongest_s = 8.0;  // that a possession of a drive takes, stop included; for the progress bar

void refuse_written(const fs::path& file) {
  if (file.empty() || !fs::exists(file)) return;
  throw UsageError{
      fmt::format("{} exists already; a record is never overwritten, choose another --out-dir", file.string())};
}

/// The settings of the drive's nodes, but for the files of world and robot.
config::Settings settings_of_drive(const calibration::DrivePlan& plan, const calibration::DriveRecord& record,
                                   config::Settings settings) {
  settings.kick_decision.policy_by_half = {plan.policy};
  settings.simulator.seed = plan.seed;
  settings.simulator.halves = 1;
  settings.simulator.max_possessions = plan.possessions;
  settings.simulator.half_minutes = plan.possessions * kLongest_s / 60.0;
  settings.scan_recorder.enabled = plan.laser;
  settings.scan_recorder.device = config::SimDevice{};
  if (plan.laser) settings.scan_recorder.file = record.scans;
  config::override_settings(settings, plan.settings);
  return lockstep_settings(std::move(settings), -1, record.log);
}

}  // namespace

calibration::DriveRecord drive_files(const fs::path& folder, const calibration::DrivePlan& plan) {
  calibration::DriveRecord record;
  record.log = (folder / (plan.name + ".db")).string();
  if (plan.laser) record.scans = (folder / (plan.name + ".scans.db")).string();
  return record;
}

void read_back(calibration::DriveRecord& record) {
  const log::Reader reader{record.log};
  record.kicks = reader.kicks();
  record.drives = calibration::recorded_drives(reader);
  if (record.scans.empty()) return;
  const log::ScanReader scans{record.scans};
  for (const auto& tested : scans.set_points()) {
    if (tested.power) record.kicked_powers.push_back(*tested.power);
  }
  record.lobs = calibration::lobs_of_scans(scans);
}

DriveMatches::DriveMatches(sim::Scenario world, config::Settings settings, fs::path folder, fs::path robot_file,
                           SignalInbox& signals)
    : world_(std::move(world)),
      settings_(std::move(settings)),
      folder_(std::move(folder)),
      robot_file_(std::move(robot_file)),
      signals_(signals) {}

calibration::DriveRecord DriveMatches::play(const calibration::DrivePlan& plan, const calibration::RobotUpdate& robot) {
  calibration::DriveRecord record = drive_files(folder_, plan);
  const fs::path scenario_file = folder_ / (plan.name + ".scenario.toml");
  refuse_written(record.scans);
  refuse_written(scenario_file);
  const LogClaim claim{record.log};
  write_file(scenario_file, config::to_toml_text(experiment::scenario_of(plan, world_)));
  robot.write(robot_file_);

  config::Settings settings = settings_;
  settings.run.robot = robot_file_.string();
  settings.run.scenario = scenario_file.string();
  settings = config::on_field_of(world_, settings_of_drive(plan, record, std::move(settings)));
  const ConfigFile config{config::to_toml_text(settings)};
  const MatchResult result = run_match("simulator", config.path(), signals_, nodes_of_match(settings), true);
  record.played_s = result.played_s;
  record.wall_s = result.wall_s;
  if (!result.trouble.empty()) {
    throw std::runtime_error{
        fmt::format("{}: {} after {:.1f} s of play; {}", plan.name, result.trouble, result.played_s,
                    claim.recorded() ? "what was recorded until then is in " + record.log : "nothing was recorded")};
  }
  if (lost_rows(record.log) > 0) throw std::runtime_error{plan.name + ": rows were lost"};
  read_back(record);
  return record;
}

}  // namespace trivela::cli
