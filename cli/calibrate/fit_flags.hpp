#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibration/robot_update.hpp"
#include "calibration/rows/drive_rows.hpp"
#include "calibration/rows/number_table.hpp"
#include "calibration/rows/trials.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "config/robot.hpp"
#include "evaluator/render/svg_chart.hpp"
#include "kicking/fit/least_squares.hpp"
#include "log/read/reader.hpp"

namespace trivela::cli {

using Json = nlohmann::ordered_json;

/// What deflection, rotation, transfer and delay have in common.
struct FitFlags {
  std::string input;
  std::string robot;  ///< name or file
  std::string out;
  std::string columns;
  std::string plot;  ///< of those that have a figure
  bool json = false;
};

void add_fit_flags(CLI::App& verb, FitFlags& flags);

/// Is the input a match log with a simulated session?
bool is_simulated(const FitFlags& flags);

/// The robot that --robot means, none without the flag. For a match log it is needed, with an effective table; `needed`
/// false: where --out is given only.
/// Throws UsageError, config::Error
std::optional<config::Robot> robot_of(const FitFlags& flags, bool needed);

/// Is the input a match log? Throws std::runtime_error for a scan record.
bool is_match_log(const FitFlags& flags);

/// The input as a table of numbers.
calibration::NumberTable number_table(const FitFlags& flags);

/// How a verb reads trials whose table has these columns.
calibration::TrialFlags trial_flags(const std::string& columns);

/// What was fitted, for people and for programs.
// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON throws nothing, the check cannot see it
struct FitReport {
  std::string text;
  Json json;
  std::vector<std::string> warnings;
};

/// Writes the figure into --out, if given, and prints the report.
/// Throws UsageError for --out without --robot, std::runtime_error where it cannot be written.
void finish_fit(const FitFlags& flags, const std::string& verb, const std::optional<config::Robot>& robot,
                FitReport report, const std::function<void(calibration::RobotUpdate&)>& update);

/// Prints text and warnings, or the JSON with the warnings in it.
void print_report(FitReport report, bool as_json);

/// Flags to rows to fit to report, robot's file and figure. `Fit` is the result and knows kName, kNeedsRobot, Flags,
/// rows of drives and of a table, and how it is made of rows; to_json(), to_text(), warnings() and set() render it, and
/// chart() where it has a figure.
template <class Fit>
void run_fit(const typename Fit::Flags& flags) {
  require_writable("--plot", flags.plot);
  const auto robot = robot_of(flags, Fit::kNeedsRobot);
  const Fit fit(is_match_log(flags) ? Fit::rows(calibration::recorded_drives(log::Reader(flags.input)), flags, robot)
                                    : Fit::rows(number_table(flags), flags, robot),
                flags, robot);
  if constexpr (requires { fit.chart(false); }) {
    if (!flags.plot.empty()) write_file(flags.plot, evaluator::to_svg(fit.chart(is_simulated(flags))));
  }
  const std::string file = std::filesystem::path(flags.input).filename().string();
  finish_fit(flags, std::string("trivela calibrate ") + Fit::kName, robot,
             {fit.to_text(), fit.to_json(), fit.warnings()},
             [&](calibration::RobotUpdate& update) { fit.set(update, {file}); });
}

/// Adds the subcommand that runs the fit. Its other flags are the caller's to add.
template <class Fit>
CLI::App* add_fit(CLI::App& calibrate, int& exit_code, const char* help,
                  const std::shared_ptr<typename Fit::Flags>& flags, const char* footer) {
  auto* verb = calibrate.add_subcommand(Fit::kName, help);
  verb->footer(footer);
  add_fit_flags(*verb, *flags);
  verb->callback([flags, &exit_code] {
    run_fit<Fit>(*flags);
    exit_code = kDone;
  });
  return verb;
}

/// {"value": ..., "se": ...}, both times `unit`.
Json json_of(const kicking::Estimate& estimate, double unit = 1.0);

/// "8.618 +- 0.339".
std::string text_of(const kicking::Estimate& estimate, double unit = 1.0);

}  // namespace trivela::cli
