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

struct RotationFlags : FitFlags {
  double distance_m = 8.0;  // paper, section 3.3
  std::optional<double> v_h_mps;
  std::optional<double> ball_offset_m;
  double cycle_s = 0.02;
  std::string plot;
};

using RotationRows = calibration::DriveKicks<kicking::RotationRow>;

RotationRows rows_of_numbers(const RotationFlags& flags) {
  const calibration::NumberTable table = calibration::NumberTable::read(flags.input, flags.columns);
  table.require_one_of({"omega_radps", "omega_degps"});
  table.require_one_of({"b_m", "allowed_error_m"});
  const bool in_degrees = !table.has("omega_radps");
  const char* const error = table.has("b_m") ? "b_m" : "allowed_error_m";
  RotationRows rows;
  table.for_each([&](const Row& row) {
    rows.rows.push_back(
        {.omega_radps = in_degrees ? kicking::radians(row.number("omega_degps")) : row.number("omega_radps"),
         .allowed_error_m = row.number(error),
         .distance_m = row.word("d_m") ? row.length_m("d_m", calibration::kFieldLength_m) : flags.distance_m});
    auto& v_h_mps = rows.rows.back().v_h_mps;
    v_h_mps = flags.v_h_mps;
    if (row.word("v_h_mps")) v_h_mps = row.positive("v_h_mps");
  });
  return rows;
}

FitReport report_of(const RotationRows& kicks, const kicking::RotationFit& fit, const kicking::RotationLever& lever) {
  FitReport report;
  report.json = {
      {"kicks", fit.beta_rad.size()},
      {"line",
       {{"slope_s", fit.line.slope.value}, {"slope_se_s", fit.line.slope.se}, {"rms_deg", degrees(fit.line.rms)}}},
      {"physical", nullptr},
      {"rows", Json::array()}};
  if (fit.delay) {
    report.json["physical"] = {{"delay_s", fit.delay->slope.value},
                               {"delay_se_s", fit.delay->slope.se},
                               {"rms_deg", degrees(fit.delay->rms)},
                               {"ball_offset_m", lever.ball_offset_m},
                               {"cycle_s", lever.cycle_s}};
  }
  std::vector<std::vector<std::string>> lines{{"omega [deg/s]", "b [m]", "d [m]", "beta [deg]", "- line [deg]"}};
  if (fit.delay) lines.front().emplace_back("- physical [deg]");
  for (std::size_t i = 0; i < kicks.rows.size(); ++i) {
    const kicking::RotationRow& row = kicks.rows[i];
    Json json{{"omega_degps", degrees(row.omega_radps)},
              {"b_m", row.allowed_error_m},
              {"d_m", row.distance_m},
              {"beta_deg", degrees(fit.beta_rad[i])},
              {"line_residual_deg", degrees(fit.line.residuals[i])}};
    lines.push_back({fmt::format("{:.1f}", degrees(row.omega_radps)), fmt::format("{:.3f}", row.allowed_error_m),
                     fmt::format("{:.2f}", row.distance_m), fmt::format("{:.3f}", degrees(fit.beta_rad[i])),
                     fmt::format("{:+.3f}", degrees(fit.line.residuals[i]))});
    if (fit.delay) {
      json["physical_residual_deg"] = degrees(fit.delay->residuals[i]);
      lines.back().push_back(fmt::format("{:+.3f}", degrees(fit.delay->residuals[i])));
    }
    report.json["rows"].push_back(std::move(json));
  }
  report.text = evaluator::text_table(lines) +
                fmt::format("\nline through the origin (paper): beta = ({} s) omega, rms {:.3f} degrees\n",
                            text_of(fit.line.slope), degrees(fit.line.rms));
  report.text += fit.delay
                     ? fmt::format(
                           "physical: beta = omega (tau + {:.3g} s) + atan(omega {:.3g} m / V_h), tau = {} "
                           "s, rms {:.3f} degrees\n",
                           0.5 * lever.cycle_s, lever.ball_offset_m, text_of(fit.delay->slope), degrees(fit.delay->rms))
                     : "delay and lever are not told apart: that needs the ball's horizontal speed (--v-h-mps)\n";
  report.warnings = kicks.left_out;
  return report;
}

/// Figure 10: beta over omega, measured, line and physical model at the mean speed of the ball.
evaluator::Chart chart_of(const RotationRows& kicks, const kicking::RotationFit& fit,
                          const kicking::RotationLever& lever, bool simulated) {
  evaluator::ChartSeries measured{simulated ? "simulated" : "measured", {}, evaluator::ChartMark::kDots, 6, 0};
  double low = 0.0, high = 0.0, v_h_mps = 0.0;
  for (std::size_t i = 0; i < kicks.rows.size(); ++i) {
    const kicking::RotationRow& row = kicks.rows[i];
    measured.points.push_back({degrees(row.omega_radps), degrees(fit.beta_rad[i])});
    low = std::min(low, row.omega_radps);
    high = std::max(high, row.omega_radps);
    v_h_mps += row.v_h_mps.value_or(0.0) / static_cast<double>(kicks.rows.size());
  }
  evaluator::Chart chart{"Lead angle of the rotation", "turn rate omega [degrees/s]", "lead angle beta [degrees]", {}};
  evaluator::ChartSeries line{"line, paper", {}, evaluator::ChartMark::kLine, 0, 0};
  evaluator::ChartSeries physical{"delay and lever", {}, evaluator::ChartMark::kLine, 1, 1};
  for (int i = 0; i <= 100; ++i) {
    const double omega = low + (high - low) * i / 100.0;
    line.points.push_back({degrees(omega), degrees(kicking::beta_paper_rad(omega, fit.line.slope.value))});
    if (!fit.delay) continue;
    const double delay_s = fit.delay->slope.value + 0.5 * lever.cycle_s;
    physical.points.push_back(
        {degrees(omega), degrees(kicking::beta_physical_rad(omega, delay_s, lever.ball_offset_m, v_h_mps))});
  }
  chart.simulated = simulated;
  chart.series = {line, measured};
  if (fit.delay) chart.series.insert(chart.series.begin() + 1, physical);
  return chart;
}

void calibrate_rotation(const RotationFlags& flags) {
  require_writable("--plot", flags.plot);
  const auto robot = robot_of(flags);
  const RotationRows kicks =
      is_match_log(flags) ? calibration::turn_kicks(calibration::recorded_drives(evaluator::log::Reader(flags.input)),
                                                    robot->model, flags.cycle_s)
                          : rows_of_numbers(flags);
  const double shipped_offset_m = robot ? robot->model.ball_offset_m : kicking::RobotModel{}.ball_offset_m;
  const kicking::RotationLever lever{flags.ball_offset_m.value_or(shipped_offset_m), flags.cycle_s};
  const kicking::RotationFit fit = kicking::fit_rotation(kicks.rows, lever);
  if (!flags.plot.empty()) write_chart(chart_of(kicks, fit, lever, is_simulated(flags)), flags.plot);
  const std::string file = std::filesystem::path(flags.input).filename().string();
  finish_fit(flags, "trivela calibrate rotation", robot, report_of(kicks, fit, lever),
             [&](calibration::RobotUpdate& update) { update.set_rotation(fit, {file}); });
}

}  // namespace

void add_calibrate_rotation(CLI::App& calibrate, int& exit_code) {
  auto* verb = calibrate.add_subcommand("rotation", "beta over turn rate (Figures 9 and 10)");
  const auto flags = std::make_shared<RotationFlags>();
  verb->footer(
      "INPUT: a table with the columns omega_degps or omega_radps, b_m or allowed_error_m[, d_m, v_h_mps]: the "
      "allowed\n"
      "error with which the ball hits the centre, positive on the right when turning counter-clockwise and on the "
      "left\n"
      "when turning clockwise; or a match log with turn drives.");
  add_fit_flags(*verb, *flags);
  verb->add_option("--distance-m", flags->distance_m, "Robot to target, where the table has no d_m")
      ->check(above_zero())
      ->capture_default_str();
  verb->add_option("--v-h-mps", flags->v_h_mps, "Horizontal speed of the ball, to tell delay and lever apart")
      ->check(above_zero());
  verb->add_option("--ball-offset-m", flags->ball_offset_m, "Robot's centre to ball; default the robot's")
      ->check(CLI::Range(0.0, 0.6));
  verb->add_option("--cycle-s", flags->cycle_s, "Control cycle: the order is half of it late on average")
      ->check(CLI::Range(0.0, 0.5))
      ->capture_default_str();
  verb->add_option("--plot", flags->plot, "Figure 10 as SVG")->type_name("FILE");
  verb->callback([flags, &exit_code] {
    calibrate_rotation(*flags);
    exit_code = kDone;
  });
}

}  // namespace trivela::cli
