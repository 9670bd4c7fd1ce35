#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include "cli/factorial/play.hpp"
#include "cli/frontier/report.hpp"
#include "cli/launch/progress_bar.hpp"
#include "cli/simulate/arms.hpp"
#include "cli/verbs.hpp"
#include "config/scenario.hpp"

namespace trivela::cli {
namespace {

struct FrontierFlags {
  std::string policy = "predictive";
  std::vector<double> thresholds{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95};
  PlayPlan plan{.matches = 400, .jobs = std::max(1u, std::thread::hardware_concurrency())};
  std::string scenario = TRIVELA_CONFIG_DIR "/scenarios/default.toml";
  ArmBase base{TRIVELA_CONFIG_DIR "/default.toml", {}, {}};
  std::string csv, svg;
  bool json = false;
};

void write(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  std::ofstream out{path};
  if (!(out << text) || !out.flush()) throw std::runtime_error{"cannot write " + path};
}

void frontier(const FrontierFlags& flags) {
  const sim::Scenario scenario = config::load_scenario(flags.scenario);
  std::vector<double> thresholds = flags.thresholds;
  std::ranges::sort(thresholds);
  std::vector<nodes::Arm> arms;
  for (const double threshold : thresholds) {
    nodes::Arm arm = arms_of(flags.policy, flags.base).front();
    arm.settings.policy.predictive.threshold = threshold;
    arms.push_back(std::move(arm));
  }
  for (nodes::Arm& arm : arms_of("stopped,moving,oracle", flags.base)) arms.push_back(std::move(arm));
  ProgressBar bar;
  auto played = play_arms(scenario, arms, flags.plan, [&](std::size_t done, std::size_t all) {
    bar.show(static_cast<double>(done), static_cast<double>(all), "the frontier");
  });
  FrontierReport report{.policy = flags.policy,
                        .scenario = std::filesystem::path{flags.scenario}.filename().string(),
                        .seed = flags.plan.seed,
                        .matches = flags.plan.matches,
                        .possessions = flags.plan.possessions,
                        .points = {},
                        .fixed = {},
                        .oracle = {}};
  const std::size_t n = thresholds.size();
  for (std::size_t i = 0; i < n; ++i) report.points.push_back({thresholds[i], std::move(played[i])});
  for (std::size_t i = n; i < n + 2; ++i) report.fixed.push_back({arms[i].name, std::move(played[i])});
  report.oracle = FixedPoint{arms[n + 2].name, std::move(played[n + 2])};
  write(flags.csv, to_csv(report));
  write(flags.svg, to_svg(report));
  fmt::print("{}", flags.json ? to_json(report).dump(2) + "\n" : to_text(report));
}

}  // namespace

void add_frontier(CLI::App& app, int& exit_code) {
  auto* const verb =
      app.add_subcommand("frontier", "Efficiency against volume, swept over a policy's firing threshold");
  const auto flags = std::make_shared<FrontierFlags>();
  verb->add_option("--policy", flags->policy, "Which is swept")
      ->check(CLI::IsMember({"predictive", "learned"}))
      ->capture_default_str();
  verb->add_option("--threshold", flags->thresholds, "Least probabilities of a ball on target that it fires at")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  verb->add_option("--matches", flags->plan.matches, "Matches of each policy and threshold")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  verb->add_option("--possessions", flags->plan.possessions, "Opportunities of a match")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  verb->add_option("--seed", flags->plan.seed, "Same seed, same opportunities")->capture_default_str();
  verb->add_option("--jobs", flags->plan.jobs, "Threads; default one a core")->check(CLI::Range(1, 256));
  verb->add_option("--scenario", flags->scenario, "The world")->check(CLI::ExistingFile)->capture_default_str();
  verb->add_option("--robot", flags->base.robots,
                   "Robot files, one for each of the team; default: the calibrated ones");
  verb->add_option("--config", flags->base.config, "Settings of the nodes")->capture_default_str();
  verb->add_option("--set", flags->base.overrides, "One setting on top, e.g. --set policy.settle_s=0.5");
  verb->add_option("--csv", flags->csv, "Every point as CSV")->type_name("FILE");
  verb->add_option("--svg", flags->svg, "The frontier as a chart")->type_name("FILE");
  verb->add_flag("--json", flags->json, "JSON instead of text");
  verb->footer(
      "Beside the frontier: stopped, moving and oracle on the same opportunities. Whether a policy lies below the\n"
      "frontier is asked at its own number of kicks, the frontier being linear between thresholds.");
  verb->callback([flags, &exit_code] {
    frontier(*flags);
    exit_code = kDone;
  });
}

}  // namespace trivela::cli
