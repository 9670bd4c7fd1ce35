#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "cli/calibrate/drive_match.hpp"
#include "cli/calibrate/robot_file.hpp"
#include "cli/calibrate/run.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "config/scenario/scenario.hpp"
#include "config/text/installation.hpp"
#include "experiment/calibration/simulated_calibration.hpp"
#include "sim/kicker/kicker.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;

// What a calibration is held to (medians over 3 to 8 m, stopped, without noise).
constexpr double kHeightGate_m = 0.10;
constexpr double kSidewaysGate_m = 0.15;

/// Where the robot's file goes. Throws UsageError where it exists.
fs::path robot_file(const RunFlags& flags) {
  fs::path file = flags.out.empty() ? fs::path{flags.out_dir} / (flags.robot + ".toml") : fs::path{flags.out};
  if (fs::exists(file)) {
    throw UsageError{
        fmt::format("{} exists already; a calibration from scratch does not overwrite it: choose another "
                    "--robot, --out-dir or --out",
                    file.string())};
  }
  return fs::absolute(file);
}

struct Worlds {
  sim::Scenario drives;
  sim::Scenario check;  // without noise
};

/// The worlds of drives and check, with a kicker as fast as the team's robot where one is named, and with a lever where
/// the robot has several kinds of kick.
Worlds worlds_of(const RunFlags& flags) {
  Worlds worlds{config::load_scenario(flags.scenario), config::load_scenario(flags.check)};
  if (!flags.team.empty()) {
    const sim::Kicker kicker = sim::team_kicker(config::load_scenario(flags.team), flags.number);
    worlds.drives.kicker.speed_scale_ratio = worlds.check.kicker.speed_scale_ratio = kicker.speed_scale_ratio;
  }
  if (config::load_robot(flags.start).model.kinds() > 1)
    worlds.drives.kicker.flat.enabled = worlds.check.kicker.flat.enabled = true;
  return worlds;
}

experiment::SimulatedCalibrationOptions options_of(const RunFlags& flags, const sim::Scenario& world) {
  config::Settings settings = config::load_settings(flags.config);
  settings.run.log_level = flags.log_level;
  return {.scenario = world,
          .settings = experiment::calibration_settings(std::move(settings), world),
          .start = config::load_robot(flags.start),
          .name = flags.robot,
          .seed = flags.seed,
          .effort = flags.effort,
          .flags = flags.team.empty() ? "" : fmt::format(" --team {} --number {}", flags.team, flags.number),
          .date = today()};
}

}  // namespace

fs::path place_of(const RunFlags& flags) {
  robot_target(flags.robot, flags.out);  // refuses what is no name
  fs::path file = robot_file(flags);
  std::error_code failed;
  fs::create_directories(flags.out_dir, failed);
  if (failed) throw std::runtime_error{fmt::format("cannot make --out-dir {}: {}", flags.out_dir, failed.message())};
  require_writable("the robot's file", file);
  return file;
}

calibration::DrivePlan check_plan(const RunFlags& flags, bool laser) {
  return {.name = "6_check",
          .policy = kicking::PolicyName::kStopped,
          .laser = laser,
          .possessions = flags.effort.check_kicks,
          .seed = flags.seed,
          .settings = {}};
}

bool passes_gate(const experiment::AimErrors& observed) {
  if (observed.median_height_m <= kHeightGate_m && observed.median_sideways_m <= kSidewaysGate_m) return true;
  fmt::print(stderr, "trivela: the check missed its gate: {} m in height and {} m sideways\n", kHeightGate_m,
             kSidewaysGate_m);
  return false;
}

namespace {

int calibrate_in_simulation(const RunFlags& flags) {
  if (!flags.overrides.empty()) throw UsageError{"--set goes with --in field"};
  if (flags.rehearse) throw UsageError{"--rehearse goes with --in field"};
  const Worlds worlds = worlds_of(flags);
  const experiment::SimulatedCalibrationOptions options = options_of(flags, worlds.drives);
  const config::Settings& settings = options.settings;
  const fs::path file = place_of(flags);
  fs::path part = file;
  part += ".part";  // until every figure is in it

  SignalInbox signals;
  const auto source_in = [&](const sim::Scenario& world) -> std::unique_ptr<calibration::DriveSource> {
    if (flags.in_process) return std::make_unique<experiment::DrivesInProcess>(world, settings);
    return std::make_unique<DriveMatches>(world, settings, fs::absolute(flags.out_dir), part, signals);
  };
  RunReport report{flags.json};
  const experiment::SimulatedCalibration calibration = experiment::play_calibration(
      options, *source_in(worlds.drives), [&](const calibration::DriveSummary& summary) { report.add(summary); });
  calibration.robot.write(file);

  const calibration::DriveRecord played =
      source_in(worlds.check)->play(check_plan(flags, worlds.check.laser.enabled), calibration.robot);
  std::error_code none;
  fs::remove(part, none);
  const experiment::AimErrors observed = experiment::observed_errors(played.kicks, settings);
  report.finish(calibration.robot, file.string(), observed, experiment::true_errors(played.kicks, settings),
                experiment::against_world(calibration.robot.robot(), worlds.drives, settings));
  return passes_gate(observed) ? kDone : kDoneWithLoss;
}

int calibrate(const RunFlags& flags) {
  return flags.in == "field" ? calibrate_in_field(flags) : calibrate_in_simulation(flags);
}

void add_place_options(CLI::App& verb, RunFlags& flags) {
  verb.add_option("--in", flags.in, "simulation, or field: on a robot, asking a person for each step")
      ->required()
      ->check(CLI::IsMember({"simulation", "field"}));
  add_default(verb, "--robot", flags.robot, "name of the calibrated robot");
  add_default(verb, "--seed", flags.seed, "same seed, same drives", CLI::Range(0, 1000000));
  add_default(verb, "--out-dir", flags.out_dir, "folder of the records");
  verb.add_option("--out", flags.out, "the robot's file; default NAME.toml in --out-dir");
}

void add_drive_options(CLI::App& verb, RunFlags& flags) {
  add_default(verb, "--start", flags.start, "the robot's file to start from");
  add_default(verb, "--scenario", flags.scenario, "world of the drives");
  add_default(verb, "--check-scenario", flags.check, "world of the check");
  verb.add_option("--team", flags.team,
                  "scenario of the matches: the drives have a kicker as fast as one of its robots")
      ->check(readable_file());
  add_default(verb, "--number", flags.number, "which robot of the team", CLI::Range(1, 5));
  add_default(verb, "--config", flags.config, "configuration of the nodes");
  verb.add_option("--set", flags.overrides, "field: one setting on top, e.g. --set 'hal.kicker=\"ioboard\"'");
}

void add_effort_options(CLI::App& verb, calibration::CalibrationEffort& effort) {
  add_default(verb, "--kicks", effort.kicks, "standing kicks with each set-point, a round", CLI::Range(2, 200));
  add_default(verb, "--lobs", effort.lobs, "accepted lobs that each set-point shall have", CLI::Range(2, 100));
  add_default(verb, "--drive-kicks", effort.drive_kicks, "lateral and straight kicks with each velocity",
              CLI::Range(1, 200));
  add_default(verb, "--turn-kicks", effort.turn_kicks, "kicks with each step of the turn drive's bisection",
              CLI::Range(1, 100));
}

}  // namespace

void add_calibrate_run(CLI::App& calibrate_verb, int& exit_code) {
  const auto [verb, flags] =
      add_verb(calibrate_verb, exit_code, "run", "all test drives, from an uncalibrated robot to its file", calibrate);
  verb->footer(
      R"(Plays the drives through the real nodes: standing kicks over the laser (table, exit angle, delay, spreads), lateral
passes (alpha), turns on the spot (beta), straight runs (transfer), and a check with the finished robot. Logs,
scans and scenarios stay in --out-dir. Exit code 3: the check was off by more than 0.10 m in height or 0.15 m
sideways (medians).
--in field asks before each step and goes on, started again, where it ended.)");
  add_place_options(*verb, *flags);
  add_drive_options(*verb, *flags);
  add_effort_options(*verb, flags->effort);
  add_default(*verb, "--log-level", flags->log_level, "of the nodes",
              CLI::IsMember(std::vector<std::string>(config::kLogLevels.begin(), config::kLogLevels.end())));
  verb->add_flag("--rehearse", flags->rehearse, "field: the same questions, played in the world of --scenario");
  verb->add_flag("--in-process", flags->in_process,
                 "without bus, nodes and records: the same robot in seconds; nothing but its file is written");
  verb->add_flag("--json", flags->json, "report as JSON on standard output");
}

}  // namespace trivela::cli
