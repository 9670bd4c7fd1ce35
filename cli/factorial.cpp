#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include "cli/calibrate/robot_file.hpp"
#include "cli/factorial/play.hpp"
#include "cli/factorial/report.hpp"
#include "cli/launch/progress_bar.hpp"
#include "cli/verbs.hpp"
#include "config/scenario.hpp"

namespace trivela::cli {
namespace {

struct FactorialFlags {
  PlayPlan plan{.jobs = std::max(1u, std::thread::hardware_concurrency())};
  std::string scenario = TRIVELA_CONFIG_DIR "/scenarios/default.toml";
  std::string config = TRIVELA_CONFIG_DIR "/default.toml";
  std::vector<std::string> robots{"calibrated_1"};
  std::vector<double> opponent_medians_m{0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0};
  Law law = Law::kReleased;
  bool no_sweep = false;
  std::string csv, svg;
  bool json = false;
};

void write(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  std::ofstream out{path};
  if (!(out << text) || !out.flush()) throw std::runtime_error{"cannot write " + path};
}

std::vector<std::vector<MatchTally>> play(const sim::Scenario& scenario, const std::vector<nodes::Arm>& arms,
                                          const PlayPlan& plan, const std::string& what) {
  ProgressBar bar;
  return play_arms(scenario, arms, plan, [&](std::size_t done, std::size_t all) {
    bar.show(static_cast<double>(done), static_cast<double>(all), what);
  });
}

void factorial(const FactorialFlags& flags) {
  const sim::Scenario scenario = config::load_scenario(flags.scenario);
  const config::Settings settings = config::load_settings(flags.config);
  FactorialReport report{.scenario = std::filesystem::path{flags.scenario}.filename().string(),
                         .seed = flags.plan.seed,
                         .matches = flags.plan.matches,
                         .possessions = flags.plan.possessions,
                         .hand_eye_sd_m = scenario.hand_table.eye_height_sd_m,
                         .hand_day_sd_ratio = scenario.hand_table.day_sd_ratio,
                         .opponent_median_m = scenario.opponent.distance_median_m,
                         .sweep_law = flags.law};
  std::vector<config::Robot> robots;
  for (const std::string& robot : flags.robots) {
    robots.push_back(config::load_robot(find_robot(robot)));
    report.robots.push_back(robots.back().name);
  }
  std::vector<nodes::Arm> arms;
  for (const Cell& cell : factorial_cells()) {
    report.cells.push_back({cell, {}});
    arms.push_back(arm_of(cell, settings, robots));
  }
  auto tallies = play(scenario, arms, flags.plan, "the factorial");
  for (std::size_t i = 0; i < arms.size(); ++i) report.cells[i].matches = std::move(tallies[i]);

  const std::vector<nodes::Arm> pair{arm_of({"old", kicking::PolicyName::kStopped, flags.law}, settings, robots),
                                     arm_of({"new", kicking::PolicyName::kMoving, flags.law}, settings, robots)};
  std::vector<double> medians_m = flags.no_sweep ? std::vector<double>{} : flags.opponent_medians_m;
  std::ranges::sort(medians_m);
  for (const double median_m : medians_m) {
    sim::Scenario world = scenario;
    world.opponent.distance_median_m = median_m;
    auto two = play(world, pair, flags.plan, fmt::format("opponents at {:g} m", median_m));
    report.sweep.push_back({median_m, std::move(two[0]), std::move(two[1])});
  }
  write(flags.csv, to_csv(report));
  write(flags.svg, to_svg(report));
  fmt::print("{}", flags.json ? to_json(report).dump(2) + "\n" : to_text(report));
}

}  // namespace

void add_factorial(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("factorial", "What calibration buys and what motion buys, in simulation");
  const auto flags = std::make_shared<FactorialFlags>();
  verb->add_option("--matches", flags->plan.matches, "Matches of each cell")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  verb->add_option("--possessions", flags->plan.possessions, "Opportunities of a match")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  verb->add_option("--seed", flags->plan.seed, "Same seed, same opportunities")->capture_default_str();
  verb->add_option("--jobs", flags->plan.jobs, "Threads; default one a core")->check(CLI::Range(1, 256));
  verb->add_option("--scenario", flags->scenario, "The world")->check(CLI::ExistingFile)->capture_default_str();
  verb->add_option("--config", flags->config, "Configuration of the nodes")
      ->check(CLI::ExistingFile)
      ->capture_default_str();
  verb->add_option("--robot", flags->robots, "What the robots know with the new table: robot n's n-th")
      ->delimiter(',')
      ->capture_default_str();
  verb->add_option("--opponent-median", flags->opponent_medians_m, "Opponents' median distances of the sweep [m]")
      ->delimiter(',')
      ->check(CLI::Range(0.3, 50.0))
      ->capture_default_str();
  verb->add_option("--law", flags->law, "Law of both sides of the sweep")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Law>{{"paper", Law::kPaper}, {"released", Law::kReleased}, {"exact", Law::kExact}}))
      ->default_str("released");
  verb->add_flag("--no-sweep", flags->no_sweep, "The factorial alone");
  verb->add_option("--csv", flags->csv, "Every cell and point as CSV")->type_name("FILE");
  verb->add_option("--svg", flags->svg, "The interactions as a chart")->type_name("FILE");
  verb->add_flag("--json", flags->json, "JSON instead of text");
  verb->footer(
      "{old, new height table} x {stopped, moving, predictive} x {paper, released, exact law}, on the same\n"
      "opportunities. The old table is drawn anew for each match from the scenario's [hand_table].");
  verb->callback([flags, &exit_code] {
    factorial(*flags);
    exit_code = kDone;
  });
}

}  // namespace trivela::cli
