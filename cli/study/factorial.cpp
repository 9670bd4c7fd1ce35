#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "cli/calibrate/robot_file.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/study/study_run.hpp"
#include "config/text/installation.hpp"
#include "experiment/study/factorial_report.hpp"

namespace trivela::cli {
namespace {

struct FactorialFlags {
  Study study;
  std::string config = config::shipped("default.toml").string();
  std::vector<std::string> robots{"calibrated_1"};
  std::vector<double> opponent_medians_m{0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0};
  experiment::Law law = experiment::Law::kReleased;
  std::vector<double> eye_biases_m{0.0, 0.1, 0.15};
  bool no_sweep = false;
};

/// Plays every cell, on the same opportunities.
void play_cells(experiment::FactorialReport& report, StudyRun& run, const std::vector<experiment::Arm>& arms,
                const sim::Scenario& scenario) {
  auto tallies = run.play(scenario, arms, "the factorial");
  const auto cells = experiment::factorial_cells();
  for (std::size_t i = 0; i < cells.size(); ++i) report.cells.push_back({cells[i], std::move(tallies[i])});
}

/// Plays old and stopped against new and moving, by the opponents' distance and by the eye of the table's maker.
void play_sweeps(experiment::FactorialReport& report, StudyRun& run, const FactorialFlags& flags,
                 const sim::Scenario& scenario, const config::Settings& settings,
                 const std::vector<config::Robot>& robots) {
  const std::vector<experiment::Arm> pair{
      experiment::arm_of({"old", kicking::PolicyName::kStopped, flags.law}, settings, robots),
      experiment::arm_of({"new", kicking::PolicyName::kMoving, flags.law}, settings, robots)};
  for (const double median_m : flags.opponent_medians_m) {
    sim::Scenario world = scenario;
    world.opponent.distance_median_m = median_m;
    auto two = run.play(world, pair, fmt::format("opponents at {:g} m", median_m));
    report.sweep.push_back({median_m, std::move(two[0]), std::move(two[1])});
  }
  for (const double bias_m : flags.eye_biases_m) {
    sim::Scenario world = scenario;
    world.hand_table.target_height_m += bias_m;  // what seems right lies so much too high
    auto two = run.play(world, pair, fmt::format("an eye off by {:g} m", bias_m));
    report.biases.push_back({bias_m, std::move(two[0]), std::move(two[1])});
  }
}

/// What the rows depend on besides the flags of play.
std::string all_arguments_of(const FactorialFlags& flags, const sim::Scenario& scenario,
                             const std::vector<experiment::Arm>& arms) {
  std::string text = arguments_of(scenario, arms);
  if (flags.no_sweep) return text;
  return text + fmt::format("\n### sweeps\nlaw = {}\nopponent_medians_m = {}\neye_biases_m = {}\n",
                            experiment::name(flags.law), fmt::join(flags.opponent_medians_m, ","),
                            fmt::join(flags.eye_biases_m, ","));
}

ExitCode study_factorial(FactorialFlags flags) {
  require_writable(flags.study);
  flags.opponent_medians_m = sorted(flags.opponent_medians_m);
  flags.eye_biases_m = sorted(flags.eye_biases_m);
  const sim::Scenario scenario = flags.study.world.load();
  const config::Settings settings = config::load_settings(flags.config);
  experiment::FactorialReport report{.played = flags.study.played(scenario),
                                     .hand_eye_sd_m = scenario.hand_table.eye_height_sd_m,
                                     .hand_day_sd_ratio = scenario.hand_table.day_sd_ratio,
                                     .opponent_median_m = scenario.opponent.distance_median_m,
                                     .sweep_law = flags.law};
  std::vector<config::Robot> robots;
  for (const std::string& robot : flags.robots) {
    robots.push_back(config::load_robot(find_robot(robot)));
    report.robots.push_back(robots.back().name);
  }
  flags.study.draw_calibrations(scenario, {flags.config, {}, {}});
  const std::size_t calibrations = flags.study.plan.calibrations.size();
  if (calibrations > 0) report.robots = {fmt::format("{} calibrations", calibrations)};
  std::vector<experiment::Arm> arms;
  for (const experiment::Cell& cell : experiment::factorial_cells())
    arms.push_back(experiment::arm_of(cell, settings, robots));
  if (calibrations == 0) warn_of_shared_robots(scenario, arms);
  const std::size_t sweeps = flags.no_sweep ? 0 : flags.opponent_medians_m.size() + flags.eye_biases_m.size();
  StudyRun run{flags.study, "factorial", all_arguments_of(flags, scenario, arms), arms.size() + 2 * sweeps};
  const auto play = [&] {
    play_cells(report, run, arms, scenario);
    if (!flags.no_sweep) play_sweeps(report, run, flags, scenario, settings, robots);
  };
  return run.run(play, [&] { give(flags.study, report); });
}

}  // namespace

void add_study_factorial(CLI::App& study, int& exit_code) {
  auto* const verb = study.add_subcommand("factorial", "What calibration buys and what motion buys, in simulation");
  const auto flags = std::make_shared<FactorialFlags>();
  add_study_options(*verb, flags->study);
  add_svg_option(*verb, flags->study);
  verb->add_option("--config", flags->config, "Configuration of the nodes")
      ->check(readable_file())
      ->capture_default_str();
  verb->add_option("--robot", flags->robots, "What the robots know with the new table: robot n's n-th")
      ->delimiter(',')
      ->capture_default_str();
  verb->add_option("--opponent-median", flags->opponent_medians_m, "Opponents' median distances of the sweep [m]")
      ->delimiter(',')
      ->check(CLI::Range(0.3, 50.0))
      ->capture_default_str();
  verb->add_option("--eye-bias", flags->eye_biases_m,
                   "Second sweep: what seems right to the old table's maker is so much too high [m]")
      ->delimiter(',')
      ->check(CLI::Range(-0.5, 1.0))
      ->capture_default_str();
  verb->add_option("--law", flags->law, "Law of both sides of the sweeps")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, experiment::Law>{{"paper", experiment::Law::kPaper},
                                                                         {"released", experiment::Law::kReleased},
                                                                         {"exact", experiment::Law::kExact}}))
      ->default_str("released");
  verb->add_flag("--no-sweep", flags->no_sweep, "The factorial alone");
  verb->footer(
      "{old, new height table} x {stopped, moving, predictive} x {paper, released, exact law}, on the same\n"
      "opportunities. The old table is drawn again for each match from the scenario's [hand_table].");
  verb->callback([flags, &exit_code] { exit_code = study_factorial(*flags); });
}

}  // namespace trivela::cli
