#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibration/robot_update.hpp"
#include "calibration/rows/drive_rows.hpp"
#include "calibration/rows/number_table.hpp"
#include "cli/verbs.hpp"
#include "config/robot.hpp"
#include "evaluator/log/reader.hpp"
#include "evaluator/report/svg_chart.hpp"
#include "kicking/fit/least_squares.hpp"

namespace trivela::cli {

using Json = nlohmann::ordered_json;

/// What deflection, rotation, transfer and delay have in common.
struct FitFlags {
  std::string input;
  std::string robot;  ///< name or file
  std::string out;
  std::string columns;
  bool json = false;
};

void add_fit_flags(CLI::App& verb, FitFlags& flags);

/// Is the input a match log with a simulated session?
bool is_simulated(const FitFlags& flags);

/// The robot that --robot means, none without the flag. For a match log it is needed, with an effective table.
/// @throws UsageError, config::Error
std::optional<config::Robot> robot_of(const FitFlags& flags);

/// Is the input a match log? @throws std::runtime_error for a scan record.
bool is_match_log(const FitFlags& flags);

/// What was fitted, for people and for programs.
// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON throws nothing, the check cannot see it
struct FitReport {
  std::string text;
  Json json;
  std::vector<std::string> warnings;
};

/// Writes the figure into --out, if given, and prints the report.
/// @throws UsageError for --out without --robot, std::runtime_error where it cannot be written.
void finish_fit(const FitFlags& flags, const char* verb, const std::optional<config::Robot>& robot, FitReport report,
                const std::function<void(calibration::RobotUpdate&)>& update);

/// {"value": ..., "se": ...}, both times `unit`.
Json json_of(const kicking::Estimate& estimate, double unit = 1.0);

/// "8.618 +- 0.339".
std::string text_of(const kicking::Estimate& estimate, double unit = 1.0);

/// Writes a chart. @throws std::runtime_error naming the path.
void write_chart(const evaluator::Chart& chart, const std::string& path);

}  // namespace trivela::cli
