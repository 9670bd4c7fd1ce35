#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <thread>

#include "cli/calibrate/robot_file.hpp"
#include "cli/launch/progress_bar.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "config/scenario/scenario.hpp"
#include "config/text/installation.hpp"
#include "evaluator/render/json_values.hpp"
#include "experiment/calibration/calibration_check.hpp"
#include "kicking/fit/least_squares.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct RepeatFlags {
  std::uint32_t count = 50;
  std::int64_t seed = 1;
  std::string world = config::shipped("scenarios/default.toml").string();
  std::string out_dir;
  std::uint32_t matches = 100;
  std::int64_t matches_seed = 1;
  std::size_t jobs = std::max(1u, std::thread::hardware_concurrency());
  calibration::CalibrationEffort effort;
  bool json = false;
};

constexpr const char* kName = "calibration";

/// Throws, before a calibration is played, where a robot's file is there already or cannot be written.
void require_room(const RepeatFlags& flags) {
  fs::create_directories(flags.out_dir);
  for (std::uint32_t i = 0; i < flags.count; ++i) {
    const fs::path file = fs::path{flags.out_dir} / fmt::format("{}_{}.toml", kName, flags.seed + i);
    if (fs::exists(file)) throw UsageError{fmt::format("{} exists already; choose another --out-dir", file.string())};
    require_writable("--out-dir", file);
  }
}

void write_robots(const std::vector<experiment::SimulatedCalibration>& calibrations, const std::string& folder) {
  for (const experiment::SimulatedCalibration& calibration : calibrations)
    calibration.robot.write(fs::path{folder} / (calibration.robot.robot().name + ".toml"));
}

std::size_t kicks_of(const experiment::SimulatedCalibration& calibration) {
  std::size_t kicks = 0;
  for (const calibration::DriveSummary& drive : calibration.drives) {
    if (drive.played_s > 0.0) kicks += drive.kicks;  // the others look at the same kicks again
  }
  return kicks;
}

struct RepeatReport {
  double mean_kicks = 0.0;  // a calibration
  double most_kicks = 0.0;
  std::vector<experiment::StudiedFigure> figures;
  std::vector<double> rates;  // on target per opportunity, policy moving; none: no matches
};

RepeatReport play_study(const RepeatFlags& flags) {
  const sim::Scenario world = config::load_scenario(flags.world);
  experiment::SimulatedCalibrationOptions options = experiment::default_simulated_calibration();
  options.scenario = experiment::calibration_scenario(options.scenario, world);
  options.name = kName;
  options.seed = flags.seed;
  options.effort = flags.effort;
  options.date = today();
  if (!flags.out_dir.empty()) require_room(flags);
  ProgressBar bar;
  const std::vector<experiment::SimulatedCalibration> calibrations =
      experiment::play_calibrations(options, flags.count, flags.jobs, [&](std::size_t done, std::size_t all) {
        bar.show(static_cast<double>(done), static_cast<double>(all), "calibrations", "calibration");
      });
  bar.end();
  if (!flags.out_dir.empty()) write_robots(calibrations, flags.out_dir);

  std::vector<double> kicks;
  kicks.reserve(calibrations.size());
  for (const experiment::SimulatedCalibration& calibration : calibrations)
    kicks.push_back(static_cast<double>(kicks_of(calibration)));
  RepeatReport report{
      .mean_kicks = std::accumulate(kicks.begin(), kicks.end(), 0.0) / static_cast<double>(kicks.size()),
      .most_kicks = *std::max_element(kicks.begin(), kicks.end()),
      .figures = experiment::study_figures(calibrations, options),
      .rates = {}};
  if (flags.matches > 0) {
    report.rates = experiment::study_policy(calibrations, world, options.settings, kicking::PolicyName::kMoving,
                                            flags.matches, static_cast<std::uint64_t>(flags.matches_seed), flags.jobs);
  }
  return report;
}

Json json_of_repeats(const RepeatReport& report, const RepeatFlags& flags) {
  const auto figure_json = [](const experiment::StudiedFigure& figure) {
    return Json{{"key", figure.key},        {"calibrations", figure.calibrations},
                {"world", figure.world},    {"mean", figure.mean},
                {"rms_error", figure.rms},  {"standard_error", figure.mean_se},
                {"covered", figure.covered}};
  };
  Json json{{"simulated", true},
            {"calibrations", flags.count},
            {"seed", flags.seed},
            {"figures", evaluator::json_list(report.figures, figure_json)},
            {"kicks", {{"mean", report.mean_kicks}, {"most", report.most_kicks}}}};
  if (!report.rates.empty()) json["moving_on_target"] = report.rates;
  return json;
}

void print_repeats(const RepeatReport& report, const RepeatFlags& flags) {
  fmt::print("SIMULATED: {} calibrations, seeds {} to {}, {:.0f} kicks each on average, {:.0f} at most\n\n",
             flags.count, flags.seed, flags.seed + flags.count - 1, report.mean_kicks, report.most_kicks);
  fmt::print("{:<26}{:>10}{:>10}{:>11}{:>11}{:>9}\n", "", "world", "mean", "rms error", "std error", "covered");
  for (const experiment::StudiedFigure& figure : report.figures) {
    fmt::print("{:<26}{:>10.4f}{:>10.4f}{:>11.4f}{:>11.4f}{:>8.0f}%\n", figure.key, figure.world, figure.mean,
               figure.rms, figure.mean_se, 100.0 * figure.covered);
  }
  if (report.rates.empty()) return;
  const auto [least, most] = std::ranges::minmax(report.rates);
  const kicking::Spread spread = kicking::spread_of(report.rates);
  fmt::print(
      "\nmoving, {} matches of 20 possessions with each robot: on target per opportunity {:.1f} to {:.1f} %, mean "
      "{:.1f} %, sd between calibrations {:.2f} points\n",
      flags.matches, 100.0 * least, 100.0 * most, 100.0 * spread.mean, 100.0 * spread.sd);
}

int repeat_study(const RepeatFlags& flags) {
  const RepeatReport report = play_study(flags);
  if (flags.json) {
    fmt::print("{}", evaluator::json_text(json_of_repeats(report, flags)));
  } else {
    print_repeats(report, flags);
  }
  return kDone;
}

}  // namespace

void add_calibrate_repeat(CLI::App& calibrate_verb, int& exit_code) {
  const auto [verb, flags] =
      add_verb(calibrate_verb, exit_code, "repeat",
               "how sure one calibration is: many of them, beside the world's truth", repeat_study);
  verb->footer(
      R"(Plays calibrations of `trivela calibrate run --in simulation` in process, one a seed, and compares their figures with
the simulated world's: error, standard error, share of the 95 % intervals that contain the truth; and how much the
policy moving differs between the robots. No fit sees the world's truth.)");
  add_default(*verb, "--count", flags->count, "calibrations", CLI::Range(2, 10000));
  add_default(*verb, "--seed", flags->seed, "of the first; the next ones follow", CLI::Range(0, 900000));
  add_default(*verb, "--scenario", flags->world, "the world of the matches");
  verb->add_option("--out-dir", flags->out_dir, "writes the robots there");
  add_default(*verb, "--matches", flags->matches, "of 20 possessions with each robot; 0: none", CLI::Range(0, 100000));
  add_default(*verb, "--matches-seed", flags->matches_seed, "of the matches", CLI::Range(0, 1000000));
  add_default(*verb, "--jobs", flags->jobs, "threads", CLI::Range(1, 256));
  add_default(*verb, "--drive-kicks", flags->effort.drive_kicks, "lateral and straight kicks with each velocity",
              CLI::Range(1, 200));
  verb->add_flag("--json", flags->json, "as JSON");
}

}  // namespace trivela::cli
