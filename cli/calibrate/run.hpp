#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "calibration/calibration_run.hpp"
#include "calibration/robot_update.hpp"
#include "config/text/installation.hpp"
#include "evaluator/render/json_values.hpp"
#include "experiment/calibration/calibration_check.hpp"

namespace trivela::cli {

inline evaluator::Json json_of_drive(const calibration::DriveSummary& summary) {
  return {{"drive", summary.name},        {"logs", summary.logs},         {"kicks", summary.kicks},
          {"used", summary.used},         {"left_out", summary.left_out}, {"found", summary.found},
          {"played_s", summary.played_s}, {"wall_s", summary.wall_s}};
}

inline evaluator::Json json_of_aim(const experiment::AimErrors& errors) {
  return {{"kicks", errors.kicks},
          {"without_crossing", errors.without_crossing},
          {"median_height_error_m", errors.median_height_m},
          {"median_sideways_error_m", errors.median_sideways_m}};
}

inline std::string text_of_aim(const experiment::AimErrors& errors) {
  return fmt::format("{} kicks, {} without a crossing; medians: height {:.3f} m, sideways {:.3f} m", errors.kicks,
                     errors.without_crossing, errors.median_height_m, errors.median_sideways_m);
}

/// What `trivela calibrate run` says: a line a drive as it goes, and a report. With --json the lines go to standard
/// error.
class RunReport {
 public:
  explicit RunReport(bool json) : json_(json) {}

  void add(const calibration::DriveSummary& summary) {
    std::FILE* const to = json_ ? stderr : stdout;
    fmt::print(to, "{}: {} of {} kicks, {:.0f} s of play in {:.1f} s: {}\n", summary.name, summary.used, summary.kicks,
               summary.played_s, summary.wall_s, summary.found);
    for (const std::string& why : summary.left_out) fmt::print(to, "  left out: {}\n", why);
    std::fflush(to);
    document_["drives"].push_back(json_of_drive(summary));
  }

  /// On a field, where nobody knows the truth.
  static void finish(const calibration::RobotUpdate& update, const std::string& file,
                     const experiment::AimErrors& observed) {
    say_changes(update, observed, "stopped, as the robot saw it");
    fmt::print("\n{}\n", file);
  }

  void finish(const calibration::RobotUpdate& update, const std::string& file, const experiment::AimErrors& observed,
              const experiment::AimErrors& truth, const std::vector<experiment::WorldFigure>& world) {
    const auto figure_json = [](const experiment::WorldFigure& figure) {
      return evaluator::Json{{"key", figure.key},
                             {"calibrated", figure.calibrated},
                             {"world", figure.world},
                             {"difference", figure.calibrated - figure.world}};
    };
    document_["file"] = file;
    document_["robot"] = update.robot().name;
    document_["changes"] = update.changes();
    document_["check"] = json_of_aim(observed);
    document_["simulator_truth"] = {{"check", json_of_aim(truth)},
                                    {"figures", evaluator::json_list(world, figure_json)}};
    if (json_) {
      fmt::print("{}", evaluator::json_text(document_));
      return;
    }
    say_changes(update, observed, "stopped and without noise, as the robot saw it");
    fmt::print("\nThe simulator's truth, which no fit has seen\ncheck: {}\n", text_of_aim(truth));
    fmt::print("{:<26}{:>12}{:>12}{:>12}\n", "", "calibrated", "world", "difference");
    for (const experiment::WorldFigure& figure : world) {
      fmt::print("{:<26}{:>12.4f}{:>12.4f}{:>+12.4f}\n", figure.key, figure.calibrated, figure.world,
                 figure.calibrated - figure.world);
    }
    fmt::print("\n{}\n", file);
  }

 private:
  static void say_changes(const calibration::RobotUpdate& update, const experiment::AimErrors& observed,
                          const std::string& check) {
    fmt::print("\n");
    for (const std::string& line : update.changes()) fmt::print("{}\n", line);
    fmt::print("\ncheck, {}: {}\n", check, text_of_aim(observed));
  }

  bool json_;
  evaluator::Json document_{{"drives", evaluator::Json::array()}};
};

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
