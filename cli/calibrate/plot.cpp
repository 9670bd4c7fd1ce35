#include <fmt/format.h>

#include <cmath>
#include <map>

#include "calibration/rows/trials.hpp"
#include "cli/calibrate/fit_flags.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/render/table.hpp"
#include "evaluator/render/text_table.hpp"
#include "kicking/constants.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::cli {
namespace {

using kicking::Trial;

struct PlotFlags {
  std::vector<std::string> inputs;
  std::string out;
  std::string columns;
  bool json = false;
  bool csv = false;
};

/// Apex height and range of a trial's parabola, over the launch: the inverse of theta and V0 of a lob.
double height_m(const Trial& trial) {
  return std::pow(trial.exit_speed_mps * std::sin(trial.exit_angle_rad), 2) / (2.0 * kicking::kGravity_mps2);
}
double distance_m(const Trial& trial) {
  return std::pow(trial.exit_speed_mps, 2) * std::sin(2.0 * trial.exit_angle_rad) / kicking::kGravity_mps2;
}

using TrialsByPower = std::map<double, std::vector<Trial>>;

TrialsByPower by_power(const std::vector<Trial>& trials) {
  TrialsByPower powers;
  for (const Trial& trial : trials) powers[trial.power].push_back(trial);
  return powers;
}

/// Figure 5: a colour a power, a pattern a trial.
evaluator::Chart chart_of(const TrialsByPower& powers, bool simulated) {
  evaluator::Chart chart{.title = "Parabolas by kick power and trial",
                         .x_label = "distance from the launch [m]",
                         .y_label = "height over the launch [m]",
                         .series = {},
                         .simulated = simulated};
  int colour = 0;
  for (const auto& [power, trials] : powers) {
    for (std::size_t trial = 0; trial < trials.size(); ++trial) {
      evaluator::ChartSeries series{
          fmt::format("p{:g}-{}", power, trial + 1), {}, evaluator::ChartMark::kLine, colour, static_cast<int>(trial)};
      const double h = height_m(trials[trial]);
      const double d = distance_m(trials[trial]);
      for (int i = 0; i <= 80; ++i) {
        const double part = i / 80.0;
        series.points.push_back({part * d, 4.0 * h * part * (1.0 - part)});
      }
      chart.series.push_back(std::move(series));
    }
    ++colour;
  }
  return chart;
}

/// One quantity over the trials of a power.
kicking::Spread spread(const std::vector<Trial>& trials, double (*quantity)(const Trial&)) {
  std::vector<double> values;
  values.reserve(trials.size());
  for (const Trial& trial : trials) values.push_back(quantity(trial));
  return kicking::spread_of(values);
}

struct Repeatability {
  double power;
  std::size_t trials;
  kicking::Spread exit_speed_mps, exit_angle_deg, distance_m, height_m;
};

std::vector<Repeatability> repeatability(const TrialsByPower& powers) {
  std::vector<Repeatability> rows;
  for (const auto& [power, trials] : powers) {
    rows.push_back({power, trials.size(), spread(trials, [](const Trial& t) { return t.exit_speed_mps; }),
                    spread(trials, [](const Trial& t) { return kicking::degrees(t.exit_angle_rad); }),
                    spread(trials, distance_m), spread(trials, height_m)});
  }
  return rows;
}

/// Name and value of one of the eight numbers of a row; a spread of one trial is unknown.
evaluator::Table table_of(const std::vector<Repeatability>& rows, const char* form) {
  evaluator::Table table{{{"power", "power", "{:g}"}, {"trials", "trials"}}};
  for (const char* const name : {"exit_speed_mps", "exit_speed_sd_mps", "exit_angle_deg", "exit_angle_sd_deg",
                                 "distance_m", "distance_sd_m", "height_m", "height_sd_m"})
    table.columns.push_back({name, name, form});
  for (const Repeatability& row : rows) {
    auto& cells = table.rows.emplace_back(std::vector<Json>{row.power, row.trials});
    for (const kicking::Spread& of : {row.exit_speed_mps, row.exit_angle_deg, row.distance_m, row.height_m}) {
      cells.emplace_back(of.mean);
      cells.push_back(row.trials > 1 ? Json(of.sd) : Json());
    }
  }
  return table;
}

int plot(const PlotFlags& flags) {
  require_writable("--out", flags.out);
  const calibration::Trials trials = calibration::read_trials(flags.inputs, trial_flags(flags.columns));
  const TrialsByPower powers = by_power(trials.trials);
  write_file(flags.out, evaluator::to_svg(chart_of(powers, trials.simulated)));
  const evaluator::Table table = table_of(repeatability(powers), flags.csv ? "{:.6g}" : "{:.3f}");
  if (flags.json) {
    const Json json{{"file", flags.out}, {"setpoints", rows_json(table)}, {"warnings", trials.warnings}};
    fmt::print("{}", evaluator::json_text(json));
    return kDone;
  }
  if (flags.csv) {
    for (const auto& line : texts_of(table, "")) fmt::print("{}\n", fmt::join(line, ","));
  } else {
    fmt::print("{}\nWritten: {}\n", evaluator::text_table(texts_of(table)), flags.out);
  }
  for (const std::string& warning : trials.warnings) warn(warning);
  return kDone;
}

}  // namespace

void add_calibrate_plot(CLI::App& calibrate, int& exit_code) {
  const auto [verb, flags] =
      add_verb(calibrate, exit_code, "plot", "parabolas of all powers and trials (Figure 5), and their spread", plot);
  verb->footer(
      R"(INPUT as of `calibrate table`: scan records or tables of power, height_m, distance_m. Prints mean and standard
deviation of exit speed, exit angle, range and height for each power: the kicker's repeatability.)");
  verb->add_option("input", flags->inputs, "Scan records or tables of numbers; - for standard input")->required();
  verb->add_option("--out", flags->out, "Chart to write, SVG")->required()->type_name("FILE");
  verb->add_option("--columns", flags->columns, "Names of the table's columns in order, - skips one");
  auto* json = verb->add_flag("--json", flags->json, "Numbers as JSON");
  verb->add_flag("--csv", flags->csv, "Numbers as CSV")->excludes(json);
}

}  // namespace trivela::cli
