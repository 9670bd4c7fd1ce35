#pragma once

#include <fmt/core.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "calibration/calibration_run.hpp"
#include "calibration/robot_update.hpp"
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

  /// On a field, where nobody knows the truth. `check`: what was played, in words.
  void finish(const calibration::RobotUpdate& update, const std::string& file, const experiment::AimErrors& observed,
              const std::string& check = "stopped, as the robot saw it") {
    begin(update, file, observed);
    if (json_) {
      fmt::print("{}", evaluator::json_text(document_));
      return;
    }
    say_changes(update, observed, check);
    fmt::print("\n{}\n", file);
  }

  void finish(const calibration::RobotUpdate& update, const std::string& file, const experiment::AimErrors& observed,
              const experiment::AimErrors& truth, const std::vector<experiment::WorldFigure>& world) {
    begin(update, file, observed);
    evaluator::Json simulator{{"check", json_of_aim(truth)}, {"figures", evaluator::Json::array()}};
    for (const experiment::WorldFigure& figure : world) {
      simulator["figures"].push_back({{"key", figure.key},
                                      {"calibrated", figure.calibrated},
                                      {"world", figure.world},
                                      {"difference", figure.calibrated - figure.world}});
    }
    document_["simulator_truth"] = std::move(simulator);
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
  void begin(const calibration::RobotUpdate& update, const std::string& file, const experiment::AimErrors& observed) {
    document_["file"] = file;
    document_["robot"] = update.robot().name;
    document_["changes"] = update.changes();
    document_["check"] = json_of_aim(observed);
  }

  static void say_changes(const calibration::RobotUpdate& update, const experiment::AimErrors& observed,
                          const std::string& check) {
    fmt::print("\n");
    for (const std::string& line : update.changes()) fmt::print("{}\n", line);
    fmt::print("\ncheck, {}: {}\n", check, text_of_aim(observed));
  }

  bool json_;
  evaluator::Json document_{{"drives", evaluator::Json::array()}};
};

}  // namespace trivela::cli
