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

struct DeflectionFlags : FitFlags {
  std::optional<double> v_h_mps;
  std::optional<double> delay_s;
};

/// alpha over the lateral velocity.
class Deflection {
 public:
  using Flags = DeflectionFlags;
  using Rows = calibration::DriveKicks<kicking::DeflectionRow>;
  using Robot = std::optional<config::Robot>;
  static constexpr const char* kName = "deflection";
  static constexpr bool kNeedsRobot = true;

  static Rows rows(const calibration::RecordedDrives& drives, const Flags&, const Robot& robot) {
    return calibration::lateral_kicks(drives, robot->model);
  }

  static Rows rows(const calibration::NumberTable& table, const Flags& flags, const Robot&) {
    for (const char* column : {"vx_mps", "d_m", "b_m"}) table.require_one_of({column});
    Rows rows;
    table.for_each([&](const config::Row& row) {
      const double distance_m = row.length_m("d_m", calibration::kFieldLength_m);
      rows.rows.push_back({.vx_mps = row.measured("vx_mps", calibration::kFastestRobot_mps, config::kMetresPerSecond),
                           .distance_m = distance_m,
                           .b_m = row.measured("b_m", calibration::kWidestCrossing * distance_m, config::kMetres)});
      auto& v_h_mps = rows.rows.back().v_h_mps;
      v_h_mps = flags.v_h_mps;
      if (row.word("v_h_mps"))
        v_h_mps = row.measured_above_zero("v_h_mps", calibration::kFastestBall_mps, config::kMetresPerSecond);
    });
    return rows;
  }

  Deflection(Rows kicks, const Flags& flags, const Robot& robot)
      : kicks_(std::move(kicks)),
        fit_(kicking::fit_deflection(kicks_.rows,
                                     !flags.delay_s && robot ? std::optional(robot->model.delay_s) : flags.delay_s)) {}

  evaluator::Table table() const {
    evaluator::Table table{{{"vx_mps", "vx [m/s]", "{:.2f}"},
                            {"d_m", "d [m]", "{:.2f}"},
                            {"b_m", "b [m]", "{:.3f}"},
                            {"alpha_deg", "alpha [deg]", "{:.3f}"},
                            {"line_residual_deg", "- line [deg]", "{:+.3f}"},
                            {"physical_residual_deg", "- physical [deg]", "{:+.3f}"}}};
    for (std::size_t i = 0; i < kicks_.rows.size(); ++i) {
      const kicking::DeflectionRow& row = kicks_.rows[i];
      table.rows.push_back({row.vx_mps, row.distance_m, row.b_m, degrees(fit_.alpha_rad[i]),
                            degrees(fit_.line.residuals[i]), degrees(fit_.travel_residual_rad[i])});
    }
    return table;
  }

  Json to_json() const {
    Json json{{"kicks", fit_.alpha_rad.size()},
              {"line",
               {{"slope_deg_per_mps", degrees(fit_.line.slope.value)},
                {"slope_se_deg_per_mps", degrees(fit_.line.slope.se)},
                {"rms_deg", degrees(fit_.line.rms)}}},
              {"physical",
               {{"travel_s", fit_.travel.slope.value},
                {"travel_se_s", fit_.travel.slope.se},
                {"rms_deg", degrees(fit_.travel_rms_rad)},
                {"rms_m", fit_.travel.rms}}},
              {"transfer", nullptr},
              {"rows", evaluator::rows_json(table())}};
    if (fit_.lateral) {
      json["transfer"] = {{"lateral_ratio", fit_.lateral->slope.value},
                          {"lateral_ratio_se", fit_.lateral->slope.se},
                          {"rms_m", fit_.lateral->rms}};
    }
    return json;
  }

  std::string to_text() const {
    std::string text = evaluator::text_table(texts_of(table())) +
                       fmt::format(
                           "\nline through the origin (paper): alpha = {} degrees per m/s, rms {:.3f} degrees\n"
                           "physical: alpha = atan(vx T / d), T = {} s, rms {:.3f} degrees\n",
                           text_of(fit_.line.slope, degrees(1.0)), degrees(fit_.line.rms), text_of(fit_.travel.slope),
                           degrees(fit_.travel_rms_rad));
    if (fit_.lateral) {
      text += fmt::format("of T, flight and delay apart: lateral transfer k_x = {}, rms {:.3f} m\n",
                          text_of(fit_.lateral->slope), fit_.lateral->rms);
    }
    return text;
  }

  /// The robot's motion carries the ball along: where it does not, somebody counted to the other side.
  std::vector<std::string> warnings() const {
    std::vector<std::string> all = kicks_.left_out;
    const auto against = std::ranges::count_if(kicks_.rows, [](const auto& row) { return row.vx_mps * row.b_m < 0.0; });
    if (2 * against > std::ssize(kicks_.rows))
      all.push_back(fmt::format(
          "the ball goes against the robot's motion in {} of {} rows: are vx_mps and b_m positive to the right?",
          against, kicks_.rows.size()));
    return all;
  }

  /// Figure 8: alpha over vx, measured, line and physical model at the mean distance.
  evaluator::Chart chart(bool simulated) const {
    evaluator::ChartSeries measured{simulated ? "simulated" : "measured", {}, evaluator::ChartMark::kDots, 6, 0};
    double low = 0.0, high = 0.0, reach_m = 0.0;
    for (std::size_t i = 0; i < kicks_.rows.size(); ++i) {
      const kicking::DeflectionRow& row = kicks_.rows[i];
      measured.points.push_back({row.vx_mps, degrees(fit_.alpha_rad[i])});
      low = std::min(low, row.vx_mps);
      high = std::max(high, row.vx_mps);
      reach_m += (row.distance_m + row.lever_m) / static_cast<double>(kicks_.rows.size());
    }
    evaluator::ChartSeries line{"line, paper", {}, evaluator::ChartMark::kLine, 0, 0};
    evaluator::ChartSeries physical{
        fmt::format("atan(vx T / {:.3g} m)", reach_m), {}, evaluator::ChartMark::kLine, 1, 1};
    for (int i = 0; i <= 100; ++i) {
      const double vx = low + (high - low) * i / 100.0;
      line.points.push_back({vx, degrees(fit_.line.slope.value) * vx});
      physical.points.push_back({vx, degrees(kicking::alpha_atan_rad(vx, reach_m, fit_.travel.slope.value))});
    }
    return {"Deflection by the lateral velocity",
            "lateral velocity vx [m/s]",
            "deflection alpha [degrees]",
            {line, physical, measured},
            {},
            simulated};
  }

  void set(calibration::RobotUpdate& update, const std::vector<std::string>& files) const {
    update.set_deflection(fit_, files);
  }

 private:
  Rows kicks_;
  kicking::DeflectionFit fit_;
};

}  // namespace

void add_calibrate_deflection(CLI::App& calibrate, int& exit_code) {
  const auto flags = std::make_shared<DeflectionFlags>();
  auto* verb = add_fit<Deflection>(
      calibrate, exit_code, "alpha over lateral velocity (Table 1, Figure 8)", flags,
      "INPUT: a table with the columns vx_mps, d_m, b_m[, v_h_mps] (speed to the right, ball to goal line, how far "
      "right\n"
      "of where the robot pointed the ball crossed, the ball's horizontal speed), or a match log with lateral drives.");
  verb->add_option("--v-h-mps", flags->v_h_mps, "Horizontal speed of the ball, to tell flight and delay apart")
      ->check(above_zero());
  verb->add_option("--delay-s", flags->delay_s, "Order to release; default the robot's")->check(CLI::Range(0.0, 0.5));
  verb->add_option("--plot", flags->plot, "Figure 8 as SVG")->type_name("FILE");
}

}  // namespace trivela::cli
