#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include "cli/factorial/play.hpp"
#include "cli/launch/progress_bar.hpp"
#include "cli/sensitivity/report.hpp"
#include "cli/simulate/arms.hpp"
#include "cli/verbs.hpp"
#include "config/scenario.hpp"

namespace trivela::cli {
namespace {

struct SensitivityFlags {
  std::string arms = "stopped,moving,predictive";
  PlayPlan plan{.matches = 200, .jobs = std::max(1u, std::thread::hardware_concurrency())};
  std::string scenario = TRIVELA_CONFIG_DIR "/scenarios/default.toml";
  ArmBase base{TRIVELA_CONFIG_DIR "/default.toml", {}, {}};
  std::vector<std::string> inputs;
  std::string csv, svg;
  bool json = false;
};

void write(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  std::ofstream out{path};
  if (!(out << text) || !out.flush()) throw std::runtime_error{"cannot write " + path};
}

std::vector<UncertainInput> chosen(const std::vector<std::string>& keys) {
  const auto all = uncertain_inputs();
  if (keys.empty()) return {all.begin(), all.end()};
  std::vector<UncertainInput> some;
  for (const std::string& key : keys) {
    const auto found = std::ranges::find(all, key, &UncertainInput::key);
    if (found == all.end()) throw UsageError{fmt::format("--input: \"{}\" is none of the uncertain inputs", key)};
    some.push_back(*found);
  }
  return some;
}

void sensitivity(const SensitivityFlags& flags) {
  const sim::Scenario scenario = config::load_scenario(flags.scenario);
  const std::vector<nodes::Arm> arms = arms_of(flags.arms, flags.base);
  if (arms.size() < 2) throw UsageError{"--arms: two or more, each is compared with the one before it"};
  SensitivityReport report{.scenario = std::filesystem::path{flags.scenario}.filename().string(),
                           .seed = flags.plan.seed,
                           .matches = flags.plan.matches,
                           .possessions = flags.plan.possessions,
                           .arms = {},
                           .base = {},
                           .inputs = {}};
  for (const nodes::Arm& arm : arms) report.arms.push_back(arm.name);
  ProgressBar bar;
  const auto play = [&](const sim::Scenario& world, const std::string& what) {
    return play_arms(world, arms, flags.plan, [&](std::size_t done, std::size_t all) {
      bar.show(static_cast<double>(done), static_cast<double>(all), what);
    });
  };
  report.base = play(scenario, "the scenario");
  for (const UncertainInput& input : chosen(flags.inputs)) {
    PlayedInput played{input, value_of(scenario, input.key), {}};
    for (const double value : {input.low, input.high}) {
      if (value == played.value) continue;
      played.ends.push_back(
          {value, play(with(scenario, input.key, value), fmt::format("{} = {:g}", input.key, value))});
    }
    report.inputs.push_back(std::move(played));
  }
  sort_by_change(report);
  write(flags.csv, to_csv(report));
  write(flags.svg, to_svg(report));
  fmt::print("{}", flags.json ? to_json(report).dump(2) + "\n" : to_text(report));
}

}  // namespace

void add_sensitivity(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("sensitivity", "How far the comparison of policies rests on assumed inputs");
  const auto flags = std::make_shared<SensitivityFlags>();
  verb->add_option("--arms", flags->arms, "Policies, each compared with the one before it")->capture_default_str();
  verb->add_option("--matches", flags->plan.matches, "Matches of each arm and value")
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
  verb->add_option("--input", flags->inputs, "Only these, e.g. kicker.delay_s,vision.latency_s")->delimiter(',');
  verb->add_option("--csv", flags->csv, "Every arm at every value as CSV")->type_name("FILE");
  verb->add_option("--svg", flags->svg, "The changes as a chart")->type_name("FILE");
  verb->add_flag("--json", flags->json, "JSON instead of text");
  verb->footer(
      "Each uncertain input of the scenario is set to a low and a high value (cli/sensitivity/inputs.cpp says which "
      "and\n"
      "why), one at a time, and the same opportunities are played. Robots are not calibrated anew.");
  verb->callback([flags, &exit_code] {
    sensitivity(*flags);
    exit_code = kDone;
  });
}

}  // namespace trivela::cli
