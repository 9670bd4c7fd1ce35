#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "calibration/rows/trials.hpp"
#include "cli/calibrate/fit_flags.hpp"
#include "cli/calibrate/robot_file.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/render/text_table.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::cli {
namespace {

using kicking::degrees;

struct TableFlags {
  std::vector<std::string> inputs;
  std::string robot;
  std::string out;
  std::string start;
  std::string angle = "mean";
  std::string kind = "effective";
  std::string columns;
  std::optional<double> exit_angle_deg;
  kicking::TableOptions options;
  bool json = false;
};

Json speed_sd(const kicking::TrialMean& point) {
  return point.trials > 1 ? Json(point.exit_speed_mps.sd) : Json(nullptr);
}

Json to_json(const kicking::TableFit& fit, const TableFlags& flags) {
  Json json;
  Json angle_sds_deg = Json::array();
  json["setpoints"] = Json::array();
  for (const kicking::TrialMean& point : fit.set_points) {
    json["setpoints"].push_back({{"power", point.power},
                                 {"trials", point.trials},
                                 {"exit_speed_mps", point.exit_speed_mps.mean},
                                 {"exit_angle_deg", degrees(point.exit_angle_rad.mean)},
                                 {"exit_speed_sd_mps", speed_sd(point)}});
    angle_sds_deg.push_back(point.trials > 1 ? Json(degrees(point.exit_angle_rad.sd)) : Json(nullptr));
  }
  json["exit_angle_deg"] = degrees(fit.exit_angle_rad.value);
  json["warnings"] = nullptr;  // print_report() knows them
  json["exit_angle_sds_deg"] = angle_sds_deg;
  json["exit_angle_se_deg"] = degrees(fit.exit_angle_rad.se);
  json["exit_angle_spread_deg"] = degrees(fit.angle_spread_rad);
  json["exit_speed_pooled_sd_mps"] = std::isnan(fit.exit_speed_sd_mps) ? Json(nullptr) : Json(fit.exit_speed_sd_mps);
  json["kind"] = flags.kind;
  json["angle"] = flags.angle;
  json["isotonic"] = fit.isotonic;
  json["not_rising_powers"] = Json::array();
  for (const std::size_t i : fit.not_rising) json["not_rising_powers"].push_back(fit.set_points[i].power);
  return json;
}

std::string to_text(const kicking::TableFit& fit, const TableFlags& flags) {
  std::vector<std::vector<std::string>> rows{{"power", "trials", "exit speed [m/s]", "sd", "exit angle [deg]", "sd"}};
  for (const kicking::TrialMean& point : fit.set_points) {
    const bool several = point.trials > 1;
    rows.push_back({fmt::format("{:g}", point.power), std::to_string(point.trials),
                    fmt::format("{:.3f}", point.exit_speed_mps.mean),
                    several ? fmt::format("{:.3f}", point.exit_speed_mps.sd) : "-",
                    fmt::format("{:.2f}", degrees(point.exit_angle_rad.mean)),
                    several ? fmt::format("{:.2f}", degrees(point.exit_angle_rad.sd)) : "-"});
  }
  return evaluator::text_table(rows) +
         fmt::format(
             "\nexit angle {} degrees, mean over the kicks; from set-point to set-point {:.2f}\n"
             "kind: {}{}\n",
             text_of(fit.exit_angle_rad, degrees(1.0)), degrees(fit.angle_spread_rad), flags.kind,
             fit.isotonic ? "; made to rise by pooling neighbours" : "");
}

/// One sentence a set-point that is not faster than a weaker one.
std::vector<std::string> not_rising(const kicking::TableFit& fit) {
  std::vector<std::string> sentences;
  for (const std::size_t i : fit.not_rising) {
    const auto& point = fit.set_points[i];
    sentences.push_back(fmt::format("power {:g} ({} {}) does not kick faster than a weaker one", point.power,
                                    point.trials, point.trials == 1 ? "trial" : "trials"));
  }
  return sentences;
}

int calibrate_table(const TableFlags& flags) {
  const auto target = robot_target(flags.robot, flags.out);
  require_writable("the robot's file", target);
  const calibration::TableChoice choice{
      flags.kind == "true" ? kicking::TableKind::kTrue : kicking::TableKind::kEffective, flags.angle == "per-setpoint"};
  calibration::TrialFlags how = trial_flags(flags.columns);
  how.kind = choice.kind;
  if (flags.exit_angle_deg) how.exit_angle_rad = kicking::radians(*flags.exit_angle_deg);
  calibration::RobotUpdate update(robot_to_calibrate(flags.robot, target, flags.start), "trivela calibrate table",
                                  today());

  calibration::Trials trials = calibration::read_trials(flags.inputs, how);
  const kicking::TableFit fit = kicking::fit_table(trials.trials, flags.options);
  FitReport report{to_text(fit, flags), to_json(fit, flags), std::move(trials.warnings)};
  if (!choice.angle_per_set_point && !fit.shared_angle_warning.empty())
    report.warnings.push_back(fit.shared_angle_warning);
  report.warnings.insert(report.warnings.end(), fit.warnings.begin(), fit.warnings.end());
  const std::vector<std::string> falling = not_rising(fit);
  report.warnings.insert(report.warnings.end(), falling.begin(), falling.end());
  const bool usable = fit.rises();
  if (usable) {
    std::vector<std::string> files;
    for (const std::string& input : flags.inputs) files.push_back(std::filesystem::path(input).filename().string());
    const bool replaced = std::filesystem::exists(target);
    update.set_table(fit, choice, files);
    update.write(target);
    report.json["file"] = target.string();
    report.json["replaced"] = replaced;
    report.json["changes"] = update.changes();
    report.text += fmt::format("\n{} {}:\n  {}\n", replaced ? "Brought up to date:" : "Written:", target.string(),
                               fmt::join(update.changes(), "\n  "));
  }
  print_report(std::move(report), flags.json);
  if (usable) return kDone;
  fmt::print(stderr, "trivela: {}; nothing is written: kick these again, or pool them with --isotonic\n",
             fmt::join(falling, "; "));
  return kFailed;
}

}  // namespace

void add_calibrate_table(CLI::App& calibrate, int& exit_code) {
  const auto [verb, flags] = add_verb(calibrate, exit_code, "table",
                                      "kick table and exit angle from lobs or measured tables", calibrate_table);
  verb->footer(
      R"(INPUT: scan records, or tables (CSV, or columns apart by blanks; # comments) with the columns power, height_m,
distance_m, or power, exit_speed_mps[, exit_angle_deg]. Heights and distances are of the ball's centre relative
to where it leaves: for heights over the floor subtract the ball's radius. A file of the robot that exists
keeps its other figures; its comments are not kept.)");
  verb->add_option("input", flags->inputs, "Scan records or tables of numbers; - for standard input")->required();
  verb->add_option("--robot", flags->robot, "Name of the robot")->required();
  verb->add_option("--out", flags->out,
                   "Robot's file; default config/robots/NAME.toml, or NAME.toml without that folder")
      ->type_name("FILE");
  verb->add_option("--base", flags->start, "Robot that a new file takes everything else from; default cambada_1")
      ->type_name("NAME|FILE");
  add_default(*verb, "--angle", flags->angle, "mean: one exit angle, as the paper; per-setpoint: one for each power",
              CLI::IsMember({"mean", "per-setpoint"}));
  add_default(*verb, "--kind", flags->kind, "effective: drag-free parabolas; true: fitted with drag, not for policies",
              CLI::IsMember({"effective", "true"}));
  verb->add_option("--exit-angle-deg", flags->exit_angle_deg, "Angle of exit speeds that come without one")
      ->check(CLI::Range(5.0, 80.0));
  verb->add_option("--least-angle-power", flags->options.least_angle_power,
                   "Kicks weaker than this do not count for the mean exit angle");
  verb->add_flag("--isotonic", flags->options.isotonic, "Pool set-points that do not rise, weighted by trials");
  verb->add_option("--columns", flags->columns,
                   "Names of the columns in order, - skips one: -,power,height_m,distance_m");
  verb->add_flag("--json", flags->json, "JSON instead of text");
}

}  // namespace trivela::cli
