#include <fmt/format.h>

#include "cli/calibrate/fit_flags.hpp"
#include "cli/verbs.hpp"
#include "evaluator/render/table.hpp"
#include "evaluator/render/text_table.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::cli {
namespace {

struct TransferFlags : FitFlags {
  std::optional<double> exit_angle_deg;
  std::optional<double> delay_s;
};

/// Exit angle of a row: its own, else the flag's, else the robot's at its power.
double exit_angle_rad(const config::Row& row, const TransferFlags& flags, const std::optional<config::Robot>& robot) {
  if (row.word("exit_angle_deg")) return row.acute_angle_rad("exit_angle_deg");
  if (flags.exit_angle_deg) return kicking::radians(*flags.exit_angle_deg);
  if (robot) return row.word("power") ? robot->model.exit_angle_at(row.positive("power")) : robot->model.exit_angle_rad;
  throw UsageError("the exit angle is not known: a column exit_angle_deg, --exit-angle-deg or --robot");
}

/// How much of its own speed the robot gives to the ball.
class Transfer {
 public:
  using Flags = TransferFlags;
  using Rows = calibration::DriveKicks<kicking::TransferRow>;
  using Robot = std::optional<config::Robot>;
  static constexpr const char* kName = "transfer";
  static constexpr bool kNeedsRobot = true;

  static Rows rows(const calibration::RecordedDrives& drives, const Flags&, const Robot& robot) {
    return calibration::transfer_kicks(drives, robot->model);
  }

  static Rows rows(const calibration::NumberTable& table, const Flags& flags, const Robot& robot) {
    for (const char* column : {"vy_mps", "d_m", "z_cross_m"}) table.require_one_of({column});
    table.require_one_of({"v0_mps", "power"});
    const bool by_power = !table.has("v0_mps");
    if (by_power && !robot) {
      throw UsageError(fmt::format("{} has powers and no v0_mps: it needs --robot with the table", flags.input));
    }
    if (by_power && robot->true_table) {
      throw UsageError(fmt::format("robot {} has a table of kind true; the law needs effective speeds", robot->name));
    }
    Rows rows;
    table.for_each([&](const config::Row& row) {
      rows.rows.push_back({.vy_mps = row.measured("vy_mps", calibration::kFastestRobot_mps, config::kMetresPerSecond),
                           .v0_mps = by_power ? robot->model.table.speed_for(row.positive("power"))
                                              : row.measured_above_zero("v0_mps", calibration::kFastestBall_mps,
                                                                        config::kMetresPerSecond),
                           .exit_angle_rad = exit_angle_rad(row, flags, robot),
                           .distance_m = row.length_m("d_m", calibration::kFieldLength_m),
                           .z_cross_m = row.measured("z_cross_m", calibration::kHighestCrossing_m, config::kMetres)});
    });
    return rows;
  }

  Transfer(Rows kicks, const Flags& flags, const Robot& robot)
      : kicks_(std::move(kicks)),
        tracked_(!kicks_.rows.empty() && kicks_.rows.front().track.has_value()),
        delay_s_(flags.delay_s.value_or(robot ? robot->model.delay_s : 0.0)),
        fit_(kicking::fit_transfer(kicks_.rows, delay_s_,
                                   (robot ? robot->model : kicking::RobotModel{}).ball.radius_m)) {}

  Json to_json() const {
    Json json{{"delay_s", delay_s_},
              {"standing_ratio", fit_.standing_ratio ? json_of(*fit_.standing_ratio) : Json(nullptr)},
              {"forward", json_of_direction(fit_.forward)},
              {"backward", json_of_direction(fit_.backward)},
              {"rows", evaluator::rows_json(table())}};
    return json;
  }

  std::string to_text() const {
    std::string text = evaluator::text_table(texts_of(table())) + "\n";
    if (fit_.standing_ratio) {
      text += fmt::format("kicks at rest: {} {}\n",
                          tracked_ ? "effective speed over the tracked one" : "V0 of the rows' is",
                          text_of(*fit_.standing_ratio));
    }
    return text + constants_of("forward", fit_.forward) + constants_of("backward", fit_.backward);
  }

  std::vector<std::string> warnings() const {
    std::vector<std::string> all = kicks_.left_out;
    all.insert(all.end(), fit_.failed.begin(), fit_.failed.end());
    for (const auto& [name, direction] : {std::pair{"forward", &fit_.forward}, {"backward", &fit_.backward}}) {
      if (*direction && (*direction)->exact.value < 0.0)
        all.push_back(fmt::format(
            "{}: the ball loses speed where the robot gains it: is vy_mps positive towards the goal?", name));
    }
    if (!fit_.standing_ratio)
      all.push_back("fewer than two kicks at rest: an error of the table is taken for transfer");
    return all;
  }

  void set(calibration::RobotUpdate& update, const std::vector<std::string>& files) const {
    update.set_transfer(fit_, files);
  }

 private:
  /// What was seen of a kick: its speeds behind the robot, or where it crossed.
  evaluator::Table table() const {
    evaluator::Table table{{{"vy_mps", "vy [m/s]", "{:+.2f}"}, {"v0_mps", "V0 [m/s]", "{:.3f}"}}};
    if (tracked_) {
      table.columns.insert(table.columns.end(), {{"along_mps", "along [m/s]", "{:.2f}"},
                                                 {"up_mps", "up [m/s]", "{:.3f}"},
                                                 {"residual_mps", "- fitted [m/s]", "{:+.3f}"}});
    } else {
      table.columns.insert(
          table.columns.end(),
          {{"d_m", "d [m]", "{:.2f}"}, {"z_cross_m", "z [m]", "{:.3f}"}, {"residual_m", "- exact law [m]", "{:+.3f}"}});
    }
    for (const auto* direction : {&fit_.forward, &fit_.backward}) {
      for (std::size_t i = 0; *direction && i < (*direction)->rows.size(); ++i) {
        const kicking::TransferRow& row = kicks_.rows[(*direction)->rows[i]];
        table.rows.push_back({row.vy_mps, row.v0_mps, tracked_ ? row.track->along_mps : row.distance_m,
                              tracked_ ? row.track->up_mps : row.z_cross_m, (*direction)->residual[i]});
      }
    }
    return table;
  }

  Json json_of_direction(const std::optional<kicking::TransferDirection>& direction) const {
    if (!direction) return nullptr;
    return {{"kicks", direction->kicks},
            {"exact", json_of(direction->exact)},
            {"paper", json_of(direction->paper)},
            {tracked_ ? "rms_mps" : "rms_m", direction->rms}};
  }

  std::string constants_of(const char* name, const std::optional<kicking::TransferDirection>& direction) const {
    if (!direction) return fmt::format("{}: not known, fewer than two kicks\n", name);
    return fmt::format("{} ({} kicks): k = {} in the exact law (rms {:.3f} {}), {} in the paper's\n", name,
                       direction->kicks, text_of(direction->exact), direction->rms, tracked_ ? "m/s" : "m",
                       text_of(direction->paper));
  }

  Rows kicks_;
  bool tracked_;  ///< by the flight camera
  double delay_s_;
  kicking::TransferFit fit_;
};

}  // namespace

void add_calibrate_transfer(CLI::App& calibrate, int& exit_code) {
  const auto flags = std::make_shared<TransferFlags>();
  auto* verb = add_fit<Transfer>(
      calibrate, exit_code, "how much of its own speed the robot gives to the ball", flags,
      "INPUT: a table with the columns vy_mps, power or v0_mps, d_m, z_cross_m[, exit_angle_deg] (forward speed; "
      "set-point\n"
      "or effective exit speed; ball to goal line at the order; height of the ball's centre over the floor there), or "
      "a\n"
      "match log with straight drives.");
  verb->add_option("--exit-angle-deg", flags->exit_angle_deg, "Exit angle; default the robot's")
      ->check(CLI::Range(5.0, 80.0));
  verb->add_option("--delay-s", flags->delay_s, "Order to release; default the robot's, 0 without a robot")
      ->check(CLI::Range(0.0, 0.5));
}

}  // namespace trivela::cli
