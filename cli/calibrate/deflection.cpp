#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "cli/calibrate/fit_flags.hpp"
#include "cli/calibrate/subcommands.hpp"
#include "cli/number_checks.hpp"
#include "cli/write_file.hpp"
#include "evaluator/report/text_table.hpp"
#include "kicking/alignment/deflection.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::cli {
namespace {

using kicking::degrees;

struct DeflectionFlags : FitFlags {
  std::optional<double> v_h_mps;
  std::optional<double> delay_s;
  std::string plot;
};

using DeflectionRows = calibration::DriveKicks<kicking::DeflectionRow>;

DeflectionRows rows_of_numbers(const DeflectionFlags& flags) {
  const calibration::NumberTable table = calibration::NumberTable::read(flags.input, flags.columns);
  for (const char* column : {"vx_mps", "d_m", "b_m"}) table.require_one_of({column});
  DeflectionRows rows;
  table.for_each([&](const Row& row) {
    rows.rows.push_back({.vx_mps = row.number("vx_mps"),
                         .distance_m = row.length_m("d_m", calibration::kFieldLength_m),
                         .b_m = row.number("b_m")});
    auto& v_h_mps = rows.rows.back().v_h_mps;
    v_h_mps = flags.v_h_mps;
    if (row.word("v_h_mps")) v_h_mps = row.positive("v_h_mps");
  });
  return rows;
}

FitReport report_of(const DeflectionRows& kicks, const kicking::DeflectionFit& fit) {
  FitReport report;
  report.json = {{"kicks", fit.alpha_rad.size()},
                 {"line",
                  {{"slope_deg_per_mps", degrees(fit.line.slope.value)},
                   {"slope_se_deg_per_mps", degrees(fit.line.slope.se)},
                   {"rms_deg", degrees(fit.line.rms)}}},
                 {"physical",
                  {{"travel_s", fit.travel.slope.value},
                   {"travel_se_s", fit.travel.slope.se},
                   {"rms_deg", degrees(fit.travel_rms_rad)},
                   {"rms_m", fit.travel.rms}}},
                 {"transfer", nullptr},
                 {"rows", Json::array()}};
  if (fit.lateral) {
    report.json["transfer"] = {{"lateral_ratio", fit.lateral->slope.value},
                               {"lateral_ratio_se", fit.lateral->slope.se},
                               {"rms_m", fit.lateral->rms}};
  }
  std::vector<std::vector<std::string>> lines{
      {"vx [m/s]", "d [m]", "b [m]", "alpha [deg]", "- line [deg]", "- physical [deg]"}};
  for (std::size_t i = 0; i < kicks.rows.size(); ++i) {
    const kicking::DeflectionRow& row = kicks.rows[i];
    const double alpha = degrees(fit.alpha_rad[i]);
    const double off_line = degrees(fit.line.residuals[i]);
    const double off_physical = degrees(fit.travel_residual_rad[i]);
    report.json["rows"].push_back({{"vx_mps", row.vx_mps},
                                   {"d_m", row.distance_m},
                                   {"b_m", row.b_m},
                                   {"alpha_deg", alpha},
                                   {"line_residual_deg", off_line},
                                   {"physical_residual_deg", off_physical}});
    lines.push_back({fmt::format("{:.2f}", row.vx_mps), fmt::format("{:.2f}", row.distance_m),
                     fmt::format("{:.3f}", row.b_m), fmt::format("{:.3f}", alpha), fmt::format("{:+.3f}", off_line),
                     fmt::format("{:+.3f}", off_physical)});
  }
  report.text = evaluator::text_table(lines) +
                fmt::format(
                    "\nline through the origin (paper): alpha = {} degrees per m/s, rms {:.3f} degrees\n"
                    "physical: alpha = atan(vx T / d), T = {} s, rms {:.3f} degrees\n",
                    text_of(fit.line.slope, degrees(1.0)), degrees(fit.line.rms), text_of(fit.travel.slope),
                    degrees(fit.travel_rms_rad));
  if (fit.lateral) {
    report.text += fmt::format("of T, flight and delay apart: lateral transfer k_x = {}, rms {:.3f} m\n",
                               text_of(fit.lateral->slope), fit.lateral->rms);
  }
  report.warnings = kicks.left_out;
  return report;
}

/// Figure 8: alpha over vx, measured, line and physical model at the mean distance.
evaluator::Chart chart_of(const DeflectionRows& kicks, const kicking::DeflectionFit& fit, bool simulated) {
  evaluator::ChartSeries measured{simulated ? "simulated" : "measured", {}, evaluator::ChartMark::kDots, 6, 0};
  double low = 0.0, high = 0.0, reach_m = 0.0;
  for (std::size_t i = 0; i < kicks.rows.size(); ++i) {
    const kicking::DeflectionRow& row = kicks.rows[i];
    measured.points.push_back({row.vx_mps, degrees(fit.alpha_rad[i])});
    low = std::min(low, row.vx_mps);
    high = std::max(high, row.vx_mps);
    reach_m += (row.distance_m + row.lever_m) / static_cast<double>(kicks.rows.size());
  }
  evaluator::ChartSeries line{"line, paper", {}, evaluator::ChartMark::kLine, 0, 0};
  evaluator::ChartSeries physical{fmt::format("atan(vx T / {:.3g} m)", reach_m), {}, evaluator::ChartMark::kLine, 1, 1};
  for (int i = 0; i <= 100; ++i) {
    const double vx = low + (high - low) * i / 100.0;
    line.points.push_back({vx, degrees(fit.line.slope.value) * vx});
    physical.points.push_back({vx, degrees(kicking::alpha_atan_rad(vx, reach_m, fit.travel.slope.value))});
  }
  return {"Deflection by the lateral velocity",
          "lateral velocity vx [m/s]",
          "deflection alpha [degrees]",
          {line, physical, measured},
          {},
          simulated};
}

void calibrate_deflection(const DeflectionFlags& flags) {
  require_writable("--plot", flags.plot);
  const auto robot = robot_of(flags);
  const DeflectionRows kicks =
      is_match_log(flags)
          ? calibration::lateral_kicks(calibration::recorded_drives(evaluator::log::Reader(flags.input)), robot->model)
          : rows_of_numbers(flags);
  std::optional<double> delay_s = flags.delay_s;
  if (!delay_s && robot) delay_s = robot->model.delay_s;
  const kicking::DeflectionFit fit = kicking::fit_deflection(kicks.rows, delay_s);
  if (!flags.plot.empty()) write_chart(chart_of(kicks, fit, is_simulated(flags)), flags.plot);
  const std::string file = std::filesystem::path(flags.input).filename().string();
  finish_fit(flags, "trivela calibrate deflection", robot, report_of(kicks, fit),
             [&](calibration::RobotUpdate& update) { update.set_deflection(fit, {file}); });
}

}  // namespace

void add_calibrate_deflection(CLI::App& calibrate, int& exit_code) {
  auto* verb = calibrate.add_subcommand("deflection", "alpha over lateral velocity (Table 1, Figure 8)");
  const auto flags = std::make_shared<DeflectionFlags>();
  verb->footer(
      "INPUT: a table with the columns vx_mps, d_m, b_m[, v_h_mps] (speed to the right, ball to goal line, how far "
      "right\n"
      "of where the robot pointed the ball crossed, the ball's horizontal speed), or a match log with lateral drives.");
  add_fit_flags(*verb, *flags);
  verb->add_option("--v-h-mps", flags->v_h_mps, "Horizontal speed of the ball, to tell flight and delay apart")
      ->check(above_zero());
  verb->add_option("--delay-s", flags->delay_s, "Order to release; default the robot's")->check(CLI::Range(0.0, 0.5));
  verb->add_option("--plot", flags->plot, "Figure 8 as SVG")->type_name("FILE");
  verb->callback([flags, &exit_code] {
    calibrate_deflection(*flags);
    exit_code = kDone;
  });
}

}  // namespace trivela::cli
