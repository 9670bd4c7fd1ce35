#include <fmt/format.h>

#include <algorithm>

#include "cli/calibrate/fit_flags.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/verbs.hpp"
#include "evaluator/render/table.hpp"
#include "evaluator/render/text_table.hpp"
#include "kicking/alignment/alignment.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::cli {
namespace {

using kicking::degrees;

struct RotationFlags : FitFlags {
  double distance_m = 8.0;  // paper, section 3.3
  std::optional<double> v_h_mps;
  std::optional<double> ball_offset_m;
  double cycle_s = 0.02;
};

/// beta over the turn rate.
class Rotation {
 public:
  using Flags = RotationFlags;
  using Rows = calibration::DriveKicks<kicking::RotationRow>;
  using Robot = std::optional<config::Robot>;
  static constexpr const char* kName = "rotation";
  static constexpr bool kNeedsRobot = true;

  static Rows rows(const calibration::RecordedDrives& drives, const Flags& flags, const Robot& robot) {
    return calibration::turn_kicks(drives, robot->model, flags.cycle_s);
  }

  static Rows rows(const calibration::NumberTable& table, const Flags& flags, const Robot&) {
    table.require_one_of({"omega_radps", "omega_degps"});
    table.require_one_of({"b_m", "allowed_error_m"});
    const bool in_degrees = !table.has("omega_radps");
    const char* const error = table.has("b_m") ? "b_m" : "allowed_error_m";
    Rows rows;
    table.for_each([&](const config::Row& row) {
      rows.rows.push_back(
          {.omega_radps =
               in_degrees
                   ? kicking::radians(row.measured("omega_degps", kicking::degrees(calibration::kFastestTurn_radps),
                                                   config::kDegreesPerSecond))
                   : row.measured("omega_radps", calibration::kFastestTurn_radps, config::kRadiansPerSecond),
           .allowed_error_m = row.measured(error, calibration::kFieldLength_m, config::kMetres),
           .distance_m = row.word("d_m") ? row.length_m("d_m", calibration::kFieldLength_m) : flags.distance_m});
      auto& v_h_mps = rows.rows.back().v_h_mps;
      v_h_mps = flags.v_h_mps;
      if (row.word("v_h_mps"))
        v_h_mps = row.measured_above_zero("v_h_mps", calibration::kFastestBall_mps, config::kMetresPerSecond);
    });
    return rows;
  }

  Rotation(Rows kicks, const Flags& flags, const Robot& robot)
      : kicks_(std::move(kicks)),
        lever_{flags.ball_offset_m.value_or((robot ? robot->model : kicking::RobotModel{}).ball_offset_m),
               flags.cycle_s},
        fit_(kicking::fit_rotation(kicks_.rows, lever_)) {}

  evaluator::Table table() const {
    evaluator::Table table{{{"omega_degps", "omega [deg/s]", "{:.1f}"},
                            {"b_m", "b [m]", "{:.3f}"},
                            {"d_m", "d [m]", "{:.2f}"},
                            {"beta_deg", "beta [deg]", "{:.3f}"},
                            {"line_residual_deg", "- line [deg]", "{:+.3f}"}}};
    if (fit_.delay) table.columns.push_back({"physical_residual_deg", "- physical [deg]", "{:+.3f}"});
    for (std::size_t i = 0; i < kicks_.rows.size(); ++i) {
      const kicking::RotationRow& row = kicks_.rows[i];
      table.rows.push_back({degrees(row.omega_radps), row.allowed_error_m, row.distance_m, degrees(fit_.beta_rad[i]),
                            degrees(fit_.line.residuals[i])});
      if (fit_.delay) table.rows.back().emplace_back(degrees(fit_.delay->residuals[i]));
    }
    return table;
  }

  Json to_json() const {
    Json json{
        {"kicks", fit_.beta_rad.size()},
        {"line",
         {{"slope_s", fit_.line.slope.value}, {"slope_se_s", fit_.line.slope.se}, {"rms_deg", degrees(fit_.line.rms)}}},
        {"physical", nullptr},
        {"rows", evaluator::rows_json(table())}};
    if (fit_.delay) {
      json["physical"] = {{"delay_s", fit_.delay->slope.value},
                          {"delay_se_s", fit_.delay->slope.se},
                          {"rms_deg", degrees(fit_.delay->rms)},
                          {"ball_offset_m", lever_.ball_offset_m},
                          {"cycle_s", lever_.cycle_s}};
    }
    return json;
  }

  std::string to_text() const {
    const std::string text = evaluator::text_table(texts_of(table())) +
                             fmt::format("\nline through the origin (paper): beta = ({} s) omega, rms {:.3f} degrees\n",
                                         text_of(fit_.line.slope), degrees(fit_.line.rms));
    if (!fit_.delay)
      return text + "delay and lever are not told apart: that needs the ball's horizontal speed (--v-h-mps)\n";
    return text + fmt::format(
                      "physical: beta = omega (tau + {:.3g} s) + atan(omega {:.3g} m / V_h), tau = {} "
                      "s, rms {:.3f} degrees\n",
                      0.5 * lever_.cycle_s, lever_.ball_offset_m, text_of(fit_.delay->slope), degrees(fit_.delay->rms));
  }

  std::vector<std::string> warnings() const { return kicks_.left_out; }

  /// Figure 10: beta over omega, measured, line and physical model at the mean speed of the ball.
  evaluator::Chart chart(bool simulated) const {
    evaluator::ChartSeries measured{simulated ? "simulated" : "measured", {}, evaluator::ChartMark::kDots, 6, 0};
    double low = 0.0, high = 0.0, v_h_mps = 0.0;
    for (std::size_t i = 0; i < kicks_.rows.size(); ++i) {
      const kicking::RotationRow& row = kicks_.rows[i];
      measured.points.push_back({degrees(row.omega_radps), degrees(fit_.beta_rad[i])});
      low = std::min(low, row.omega_radps);
      high = std::max(high, row.omega_radps);
      v_h_mps += row.v_h_mps.value_or(0.0) / static_cast<double>(kicks_.rows.size());
    }
    evaluator::Chart chart{
        "Lead angle of the rotation", "turn rate omega [degrees/s]", "lead angle beta [degrees]", {}};
    evaluator::ChartSeries line{"line, paper", {}, evaluator::ChartMark::kLine, 0, 0};
    evaluator::ChartSeries physical{"delay and lever", {}, evaluator::ChartMark::kLine, 1, 1};
    for (int i = 0; i <= 100; ++i) {
      const double omega = low + (high - low) * i / 100.0;
      line.points.push_back({degrees(omega), degrees(kicking::beta_paper_rad(omega, fit_.line.slope.value))});
      if (!fit_.delay) continue;
      const double delay_s = fit_.delay->slope.value + 0.5 * lever_.cycle_s;
      physical.points.push_back(
          {degrees(omega), degrees(kicking::beta_physical_rad(omega, delay_s, lever_.ball_offset_m, v_h_mps))});
    }
    chart.simulated = simulated;
    chart.series = {line, measured};
    if (fit_.delay) chart.series.insert(chart.series.begin() + 1, physical);
    return chart;
  }

  void set(calibration::RobotUpdate& update, const std::vector<std::string>& files) const {
    update.set_rotation(fit_, files);
  }

 private:
  Rows kicks_;
  kicking::RotationLever lever_;
  kicking::RotationFit fit_;
};

}  // namespace

void add_calibrate_rotation(CLI::App& calibrate, int& exit_code) {
  const auto flags = std::make_shared<RotationFlags>();
  auto* verb = add_fit<Rotation>(
      calibrate, exit_code, "beta over turn rate (Figures 9 and 10)", flags,
      "INPUT: a table with the columns omega_degps or omega_radps, b_m or allowed_error_m[, d_m, v_h_mps]: the "
      "allowed\n"
      "error with which the ball hits the centre, positive on the right when turning counter-clockwise and on the "
      "left\n"
      "when turning clockwise; or a match log with turn drives.");
  add_default(*verb, "--distance-m", flags->distance_m, "Robot to target, where the table has no d_m", above_zero());
  verb->add_option("--v-h-mps", flags->v_h_mps, "Horizontal speed of the ball, to tell delay and lever apart")
      ->check(above_zero());
  verb->add_option("--ball-offset-m", flags->ball_offset_m, "Robot's centre to ball; default the robot's")
      ->check(CLI::Range(0.0, 0.6));
  add_default(*verb, "--cycle-s", flags->cycle_s, "Control cycle: the order is half of it late on average",
              CLI::Range(0.0, 0.5));
  verb->add_option("--plot", flags->plot, "Figure 10 as SVG")->type_name("FILE");
}

}  // namespace trivela::cli
