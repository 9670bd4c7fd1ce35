#include "cli/calibrate/fit_flags.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/calibrate/robot_file.hpp"
#include "evaluator/render/json_values.hpp"

namespace trivela::cli {

void add_fit_flags(CLI::App& verb, FitFlags& flags) {
  verb.add_option("input", flags.input, "Table of numbers, or match log of the test drives; - for standard input")
      ->required();
  verb.add_option("--robot", flags.robot, "Robot to take the other figures from; needed for a match log")
      ->type_name("NAME|FILE");
  verb.add_option("--out", flags.out, "Write the robot with this figure: a new file, or --robot's own")
      ->type_name("FILE");
  verb.add_option("--columns", flags.columns, "Names of the table's columns in order, - skips one");
  verb.add_flag("--json", flags.json, "JSON instead of text");
}

bool is_match_log(const FitFlags& flags) {
  const calibration::InputKind kind = calibration::input_kind(flags.input);
  if (kind == calibration::InputKind::kScanRecord) {
    throw std::runtime_error(flags.input + " is a scan record; this needs a match log or a table of numbers");
  }
  return kind == calibration::InputKind::kMatchLog;
}

bool is_simulated(const FitFlags& flags) {
  if (!is_match_log(flags)) return false;
  const log::Reader reader{flags.input};
  return std::ranges::any_of(reader.sessions(), &log::RecordedSession::simulated);
}

calibration::NumberTable number_table(const FitFlags& flags) {
  return calibration::NumberTable::read(flags.input, flags.columns, "--columns");
}

calibration::TrialFlags trial_flags(const std::string& columns) {
  return {
      .columns = columns, .kind_called = "--kind", .angle_called = "--exit-angle-deg", .columns_called = "--columns"};
}

std::optional<config::Robot> robot_of(const FitFlags& flags, bool needed) {
  const bool log = is_match_log(flags);
  require_writable("--out", flags.out);
  if (flags.robot.empty()) {
    if (log && (needed || !flags.out.empty()))
      throw UsageError(fmt::format("{} is a match log: it needs --robot", flags.input));
    if (!flags.out.empty()) throw UsageError("--out needs --robot, the robot that the figure goes into");
    return std::nullopt;
  }
  const auto path = find_robot(flags.robot);
  return log ? config::load_robot(path) : config::load_robot_of_any_table(path);
}

void finish_fit(const FitFlags& flags, const std::string& verb, const std::optional<config::Robot>& robot,
                FitReport report, const std::function<void(calibration::RobotUpdate&)>& update) {
  namespace fs = std::filesystem;
  if (!flags.out.empty()) {
    std::error_code ignored;
    if (fs::exists(flags.out) && !fs::equivalent(flags.out, find_robot(flags.robot), ignored)) {
      throw UsageError(fmt::format("--out {} exists already and is not the file of --robot", flags.out));
    }
    calibration::RobotUpdate file(*robot, verb, today());
    update(file);
    file.write(flags.out);
    report.json["file"] = flags.out;
    report.json["changes"] = file.changes();
    report.text += fmt::format("\nWritten to {}:\n  {}\n", flags.out, fmt::join(file.changes(), "\n  "));
  }
  print_report(std::move(report), flags.json);
}

void print_report(FitReport report, bool as_json) {
  report.json["warnings"] = report.warnings;
  if (as_json) {
    fmt::print("{}", evaluator::json_text(report.json));
  } else {
    say(report.text);
    for (const std::string& warning : report.warnings) say(fmt::format("warning: {}\n", warning));
  }
}

Json json_of(const kicking::Estimate& estimate, double unit) {
  return {{"value", estimate.value * unit}, {"se", estimate.se * unit}};
}

std::string text_of(const kicking::Estimate& estimate, double unit) {
  return fmt::format("{:.4g} +- {:.2g}", estimate.value * unit, estimate.se * unit);
}

}  // namespace trivela::cli
