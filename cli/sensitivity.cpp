#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/sensitivity/report.hpp"
#include "cli/study.hpp"
#include "cli/verbs.hpp"
#include "config/scenario.hpp"

namespace trivela::cli {
namespace {

struct SensitivityFlags {
  std::string arms = "stopped@old,stopped,moving,predictive";
  Study study;
  ArmBase base{TRIVELA_CONFIG_DIR "/default.toml", {}, {}};
  std::vector<std::string> inputs;
};

std::vector<UncertainInput> chosen(const std::vector<std::string>& keys) {
  const auto all = uncertain_inputs();
  if (keys.empty()) return {all.begin(), all.end()};
  std::vector<UncertainInput> some;
  for (const std::string& key : keys) {
    const auto found = std::ranges::find(all, key, &UncertainInput::key);
    if (found == all.end()) throw UsageError{fmt::format("--input: \"{}\" is none of the uncertain inputs", key)};
    if (std::ranges::count(keys, key) > 1) throw UsageError{fmt::format("--input: \"{}\" stands twice", key)};
    some.push_back(*found);
  }
  return some;
}

/// The arms with another value of a setting.
std::vector<nodes::Arm> with(std::vector<nodes::Arm> arms, const std::string& key, double value) {
  for (nodes::Arm& arm : arms) arm.settings.policy = cli::with(arm.settings.policy, key, value);
  return arms;
}

void sensitivity(const SensitivityFlags& flags) {
  const sim::Scenario scenario = config::load_scenario(flags.study.scenario);
  const std::vector<nodes::Arm> arms = arms_of(flags.arms, flags.base);
  const std::vector<UncertainInput> inputs = chosen(flags.inputs);
  if (arms.size() < 2) throw UsageError{"--arms: two or more, each is compared with the one before it"};
  SensitivityReport report{.scenario = flags.study.scenario_name(),
                           .seed = flags.study.plan.seed,
                           .matches = flags.study.plan.matches,
                           .possessions = flags.study.plan.possessions,
                           .arms = {},
                           .base = {},
                           .inputs = {},
                           .evenings = flags.study.calibrations};
  for (const nodes::Arm& arm : arms) report.arms.push_back(arm.name);
  Study study = flags.study;
  study.draw_evenings(scenario, flags.base);
  if (study.plan.evenings.empty()) warn_of_shared_robots(scenario, arms);
  report.base = play_with_bar(scenario, arms, study.plan, "the scenario");
  for (const UncertainInput& input : inputs) {
    const bool setting = is_setting(input.key);
    PlayedInput played{
        input, setting ? value_of(arms.front().settings.policy, input.key) : value_of(scenario, input.key), {}};
    for (const double value : {input.low, input.high}) {
      if (value == played.value) continue;
      const std::string what = fmt::format("{} = {}", input.key, value_text(input.key, value));
      played.ends.push_back(
          {value, setting ? play_with_bar(scenario, with(arms, input.key, value), study.plan, what)
                          : play_with_bar(cli::with(scenario, input.key, value), arms, study.plan, what)});
    }
    report.inputs.push_back(std::move(played));
  }
  sort_by_change(report);
  give(study, report);
}

}  // namespace

void add_sensitivity(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("sensitivity", "How far the comparison of policies rests on assumed inputs");
  const auto flags = std::make_shared<SensitivityFlags>();
  flags->study.plan.matches = 200;  // of each value
  verb->add_option("--arms", flags->arms, "Policies, each compared with the one before it")->capture_default_str();
  add_study_options(*verb, flags->study);
  add_arm_options(*verb, flags->base);
  verb->add_option("--input", flags->inputs, "Only these, e.g. kicker.delay_s,vision.latency_s")->delimiter(',');
  verb->footer(
      "Each uncertain input of the scenario and each setting of the policies is set to a low and a high value\n"
      "(cli/sensitivity/inputs.cpp says which and why), one at a time, and the same opportunities are played. Robots\n"
      "are not calibrated anew. Inputs of the hand table matter to arms with it (@old) alone.");
  verb->callback([flags, &exit_code] {
    sensitivity(*flags);
    exit_code = kDone;
  });
}

}  // namespace trivela::cli
