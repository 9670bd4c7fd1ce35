#include "cli/calibrate/drive_match.hpp"

#include <fmt/core.h>

#include <utility>

#include "cli/launch/config_file.hpp"
#include "cli/launch/log_claim.hpp"
#include "cli/launch/match_run.hpp"
#include "cli/launch/record_lockstep.hpp"
#include "cli/write_file.hpp"
#include "config/scenario.hpp"

namespace trivela::cli {

namespace fs = std::filesystem;

namespace {

constexpr double kLongest_s = 8.0;  // that a possession of a drive takes, stop included; for the progress bar

}  // namespace

DriveMatches::DriveMatches(config::Settings settings, fs::path folder, SignalInbox& signals)
    : settings_(std::move(settings)), folder_(std::move(folder)), signals_(signals) {}

DriveRecord DriveMatches::play(const DrivePlan& plan, const fs::path& robot_file) {
  DriveRecord record;
  record.log = folder_ / (plan.name + ".db");
  if (plan.scenario.laser.enabled) record.scans = folder_ / (plan.name + ".scans.db");
  const fs::path scenario_file = folder_ / (plan.name + ".scenario.toml");
  for (const fs::path& file : {record.scans, scenario_file}) {
    if (!file.empty() && fs::exists(file)) {
      throw UsageError{
          fmt::format("{} exists already; a record is never overwritten, choose another --out-dir", file.string())};
    }
  }
  const LogClaim claim{record.log};
  write_file(scenario_file, config::to_toml_text(plan.scenario));

  config::Settings settings = settings_;
  settings.run.robot = robot_file.string();
  settings.run.scenario = scenario_file.string();
  settings.kick_decision.policy_by_half = {plan.policy};
  settings.simulator.seed = plan.seed;
  settings.simulator.halves = 1;
  settings.simulator.max_possessions = plan.possessions;
  settings.simulator.half_minutes = plan.possessions * kLongest_s / 60.0;
  settings.scan_recorder.enabled = plan.scenario.laser.enabled;
  settings.scan_recorder.device = "sim";
  if (plan.scenario.laser.enabled) settings.scan_recorder.file = record.scans.string();
  config::override_settings(settings, plan.settings);
  settings = lockstep_settings(std::move(settings), -1, record.log.string());

  const ConfigFile config{config::to_toml_text(settings)};
  const MatchResult result = run_match("simulator", config.path(), signals_, more_nodes(settings), true);
  record.played_s = result.played_s;
  record.wall_s = result.wall_s;
  if (!result.trouble.empty()) {
    throw std::runtime_error{fmt::format(
        "{}: {} after {:.1f} s of play; {}", plan.name, result.trouble, result.played_s,
        claim.recorded() ? "what was recorded until then is in " + record.log.string() : "nothing was recorded")};
  }
  if (lost_rows(record.log.string()) > 0) throw std::runtime_error{plan.name + ": rows were lost"};
  return record;
}

}  // namespace trivela::cli
