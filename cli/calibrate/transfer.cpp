#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/calibrate/fit_flags.hpp"
#include "cli/calibrate/subcommands.hpp"
#include "evaluator/report/text_table.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::cli {
namespace {

struct TransferFlags : FitFlags {
  std::optional<double> exit_angle_deg;
  std::optional<double> delay_s;
};

using TransferRows = calibration::DriveKicks<kicking::TransferRow>;

/// Exit angle of a row: its own, else the flag's, else the robot's at its power.
double exit_angle_rad(const Row& row, const TransferFlags& flags, const std::optional<config::Robot>& robot) {
  if (row.word("exit_angle_deg")) return row.acute_angle_rad("exit_angle_deg");
  if (flags.exit_angle_deg) return kicking::radians(*flags.exit_angle_deg);
  if (robot) return row.word("power") ? robot->model.exit_angle_at(row.positive("power")) : robot->model.exit_angle_rad;
  throw UsageError("the exit angle is not known: a column exit_angle_deg, --exit-angle-deg or --robot");
}

TransferRows rows_of_numbers(const TransferFlags& flags, const std::optional<config::Robot>& robot) {
  const calibration::NumberTable table = calibration::NumberTable::read(flags.input, flags.columns);
  for (const char* column : {"vy_mps", "d_m", "z_cross_m"}) table.require_one_of({column});
  table.require_one_of({"v0_mps", "power"});
  const bool by_power = !table.has("v0_mps");
  if (by_power && !robot) {
    throw UsageError(fmt::format("{} has powers and no v0_mps: it needs --robot with the table", flags.input));
  }
  if (by_power && robot->true_table) {
    throw UsageError(fmt::format("robot {} has a table of kind true; the law needs effective speeds", robot->name));
  }
  TransferRows rows;
  table.for_each([&](const Row& row) {
    rows.rows.push_back(
        {.vy_mps = row.number("vy_mps"),
         .v0_mps = by_power ? robot->model.table.speed_for(row.positive("power")) : row.positive("v0_mps"),
         .exit_angle_rad = exit_angle_rad(row, flags, robot),
         .distance_m = row.length_m("d_m", calibration::kFieldLength_m),
         .z_cross_m = row.number("z_cross_m")});
  });
  return rows;
}

Json json_of_direction(const std::optional<kicking::TransferDirection>& direction, bool tracked) {
  if (!direction) return nullptr;
  return {{"kicks", direction->kicks},
          {"exact", json_of(direction->exact)},
          {"paper", json_of(direction->paper)},
          {tracked ? "rms_mps" : "rms_m", direction->rms}};
}

FitReport report_of(const TransferRows& kicks, const kicking::TransferFit& fit, double delay_s) {
  const bool tracked = !kicks.rows.empty() && kicks.rows.front().track.has_value();
  FitReport report;
  report.json = {{"delay_s", delay_s},
                 {"standing_ratio", fit.standing_ratio ? json_of(*fit.standing_ratio) : Json(nullptr)},
                 {"forward", json_of_direction(fit.forward, tracked)},
                 {"backward", json_of_direction(fit.backward, tracked)},
                 {"rows", Json::array()}};
  std::vector<std::vector<std::string>> lines{{"vy [m/s]", "V0 [m/s]"}};
  for (const char* column : {tracked ? "along [m/s]" : "d [m]", tracked ? "up [m/s]" : "z [m]",
                             tracked ? "- fitted [m/s]" : "- exact law [m]"})
    lines.front().emplace_back(column);
  std::string constants;
  const auto add = [&](const char* name, const std::optional<kicking::TransferDirection>& direction) {
    if (!direction) {
      constants += fmt::format("{}: not known, fewer than two kicks\n", name);
      return;
    }
    for (std::size_t i = 0; i < direction->rows.size(); ++i) {
      const kicking::TransferRow& row = kicks.rows[direction->rows[i]];
      const double second = tracked ? row.track->along_mps : row.distance_m;
      const double third = tracked ? row.track->up_mps : row.z_cross_m;
      report.json["rows"].push_back({{"vy_mps", row.vy_mps},
                                     {"v0_mps", row.v0_mps},
                                     {tracked ? "along_mps" : "d_m", second},
                                     {tracked ? "up_mps" : "z_cross_m", third},
                                     {tracked ? "residual_mps" : "residual_m", direction->residual[i]}});
      lines.push_back({fmt::format("{:+.2f}", row.vy_mps), fmt::format("{:.3f}", row.v0_mps),
                       fmt::format("{:.2f}", second), fmt::format("{:.3f}", third),
                       fmt::format("{:+.3f}", direction->residual[i])});
    }
    constants += fmt::format("{} ({} kicks): k = {} in the exact law (rms {:.3f} {}), {} in the paper's\n", name,
                             direction->kicks, text_of(direction->exact), direction->rms, tracked ? "m/s" : "m",
                             text_of(direction->paper));
  };
  if (fit.standing_ratio)
    constants =
        fmt::format("kicks at rest: {} {}\n", tracked ? "effective speed over the tracked one" : "V0 of the rows' is",
                    text_of(*fit.standing_ratio));
  add("forward", fit.forward);
  add("backward", fit.backward);
  report.text = evaluator::text_table(lines) + "\n" + constants;
  report.warnings = kicks.left_out;
  report.warnings.insert(report.warnings.end(), fit.failed.begin(), fit.failed.end());
  if (!fit.standing_ratio) {
    report.warnings.push_back("fewer than two kicks at rest: an error of the table is taken for transfer");
  }
  return report;
}

void calibrate_transfer(const TransferFlags& flags) {
  const auto robot = robot_of(flags);
  const TransferRows kicks =
      is_match_log(flags)
          ? calibration::transfer_kicks(calibration::recorded_drives(evaluator::log::Reader(flags.input)), robot->model)
          : rows_of_numbers(flags, robot);
  const double delay_s = flags.delay_s.value_or(robot ? robot->model.delay_s : 0.0);
  const double ball_radius_m = (robot ? robot->model : kicking::RobotModel{}).ball.radius_m;
  const kicking::TransferFit fit = kicking::fit_transfer(kicks.rows, delay_s, ball_radius_m);
  const std::string file = std::filesystem::path(flags.input).filename().string();
  finish_fit(flags, "trivela calibrate transfer", robot, report_of(kicks, fit, delay_s),
             [&](calibration::RobotUpdate& update) { update.set_transfer(fit, {file}); });
}

}  // namespace

void add_calibrate_transfer(CLI::App& calibrate, int& exit_code) {
  auto* verb = calibrate.add_subcommand("transfer", "how much of its own speed the robot gives to the ball");
  const auto flags = std::make_shared<TransferFlags>();
  verb->footer(
      "INPUT: a table with the columns vy_mps, power or v0_mps, d_m, z_cross_m[, exit_angle_deg] (forward speed; "
      "set-point\n"
      "or effective exit speed; ball to goal line at the order; height of the ball's centre over the floor there), or "
      "a\n"
      "match log with straight drives.");
  add_fit_flags(*verb, *flags);
  verb->add_option("--exit-angle-deg", flags->exit_angle_deg, "Exit angle; default the robot's")
      ->check(CLI::Range(5.0, 80.0));
  verb->add_option("--delay-s", flags->delay_s, "Order to release; default the robot's, 0 without a robot")
      ->check(CLI::Range(0.0, 0.5));
  verb->callback([flags, &exit_code] {
    calibrate_transfer(*flags);
    exit_code = kDone;
  });
}

}  // namespace trivela::cli
