#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "calibration/rows/kick_flights.hpp"
#include "cli/calibrate/fit_flags.hpp"
#include "cli/calibrate/robot_file.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "config/settings.hpp"
#include "config/text/installation.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/learning/kicker_learner.hpp"

namespace trivela::cli {
namespace {

constexpr std::size_t kFewest = 5;  // kicks that a file may be written from

struct FromLogFlags {
  std::vector<std::string> logs;
  std::string robot;
  int robot_id = 1;
  std::string base;
  std::string out;
  std::string config = config::shipped("default.toml").string();
  bool json = false;
};

/// Kick by kick; from match to match the kicker may have changed as from day to day.
kicking::KickerEstimate learned(const std::vector<calibration::LoggedFlight>& flights, const kicking::RobotModel& file,
                                const kicking::KickerChange& change) {
  kicking::KickerLearner learner(file, change);
  std::uint32_t kicks = 0;
  for (std::size_t i = 0; i < flights.size(); ++i) {
    if (i > 0 && flights[i].match != flights[i - 1].match) learner.begin_with(learner.estimate());
    kicks += learner.learn(flights[i].flight) ? 1 : 0;
  }
  kicking::KickerEstimate estimate = learner.estimate();
  estimate.kicks = kicks;
  return estimate;
}

Json to_json(const kicking::KickerEstimate& estimate, const calibration::LoggedFlights& seen) {
  const auto part = [&](kicking::KickerPart of) { return json_of({estimate.mean[of], estimate.se[of]}); };
  return {{"kicks", seen.kicks},
          {"learned_from", estimate.kicks},
          {"speed_ln", part(kicking::kSpeedPart)},
          {"elevation_rad", part(kicking::kElevationPart)},
          {"direction_rad", part(kicking::kDirectionPart)},
          {"delay_s", part(kicking::kDelayPart)},
          {"along_ratio", part(kicking::kAlongPart)},
          {"sideways_ratio", part(kicking::kSidewaysPart)},
          {"simulated", seen.simulated}};
}

int calibrate_from_log(const FromLogFlags& flags) {
  const auto target = robot_target(flags.robot, flags.out);
  require_writable("the robot's file", target);
  const config::Settings settings = config::load_settings(flags.config);
  calibration::RobotUpdate update(robot_to_calibrate(flags.robot, target, flags.base), "trivela calibrate from-log",
                                  today());
  const kicking::RobotModel file = update.robot().model;
  const calibration::LoggedFlights seen =
      calibration::flights_in({flags.logs.begin(), flags.logs.end()}, flags.robot_id, file.delay_s);
  const kicking::KickerEstimate estimate = learned(seen.flights, file, settings.self_calibration.change);
  if (estimate.kicks < kFewest) {
    fmt::print(stderr,
               "trivela: robot {} has {} kicks in {} log(s), of which {} were seen to fly, {} are needed; kicks of "
               "robot(s): {}. Nothing is written\n",
               flags.robot_id, seen.kicks, flags.logs.size(), estimate.kicks, kFewest,
               seen.robots.empty() ? "none" : fmt::format("{}", fmt::join(seen.robots, ", ")));
    return kFailed;
  }
  std::vector<std::string> files;
  for (const std::string& log : flags.logs) files.push_back(std::filesystem::path(log).filename().string());
  const bool replaced = std::filesystem::exists(target);
  update.set_play(estimate, files);
  update.write(target);
  FitReport report{
      fmt::format("{}robot {}: {} of {} kicks were seen to fly\n\n{} {}:\n  {}\n", seen.simulated ? "SIMULATED. " : "",
                  flags.robot_id, estimate.kicks, seen.kicks,
                  replaced ? "Brought up to date:" : "Written:", target.string(), fmt::join(update.changes(), "\n  ")),
      to_json(estimate, seen), seen.remarks};
  report.json["warnings"] = nullptr;  // print_report() knows them
  report.json["file"] = target.string();
  report.json["replaced"] = replaced;
  report.json["changes"] = update.changes();
  print_report(std::move(report), flags.json);
  return kDone;
}

}  // namespace

void add_calibrate_from_log(CLI::App& calibrate, int& exit_code) {
  const auto [verb, flags] =
      add_verb(calibrate, exit_code, "from-log", "A robot's file from its kicks in matches", calibrate_from_log);
  verb->footer(
      R"(Each kick whose flight a goal camera saw says something of exit speed, angle, direction, delay and transfer. The
robot's file that is there, or --base, is what they are held against: the file that the robot played with.)");
  verb->add_option("log", flags->logs, "Match logs")->required()->type_name("LOG");
  verb->add_option("--robot", flags->robot, "Name of the robot")->required();
  add_default(*verb, "--robot-id", flags->robot_id, "Its number in the logs", CLI::Range(1, 255));
  verb->add_option("--base", flags->base, "Robot that a new file starts from; default cambada_1")
      ->type_name("NAME|FILE");
  verb->add_option("--out", flags->out,
                   "Robot's file; default config/robots/NAME.toml, or NAME.toml without that folder")
      ->type_name("FILE");
  add_default(*verb, "--config", flags->config, "Settings, of which [self_calibration.change] counts");
  verb->add_flag("--json", flags->json, "JSON instead of text");
}

}  // namespace trivela::cli
