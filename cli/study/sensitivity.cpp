#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>

#include "cli/study/study_run.hpp"
#include "config/text/installation.hpp"
#include "experiment/study/sensitivity.hpp"

namespace trivela::cli {
namespace {

struct SensitivityFlags {
  std::string arms = "stopped@old,stopped,moving,predictive";
  Study study;
  experiment::ArmBase base{config::shipped("default.toml").string(), {}, {}};
  std::string table = config::shipped("studies/sensitivity.csv").string();
  std::vector<std::string> inputs;
  bool goals = false;
};

std::vector<experiment::UncertainInput> chosen(const std::vector<experiment::UncertainInput>& all,
                                               const std::vector<std::string>& keys, const sim::Scenario& scenario) {
  std::vector<experiment::UncertainInput> some;
  if (keys.empty()) {
    std::ranges::copy_if(all, std::back_inserter(some),
                         [&](const auto& input) { return experiment::in_force(scenario, input); });
    return some;
  }
  for (const std::string& key : keys) {
    const auto found = std::ranges::find(all, key, &experiment::UncertainInput::key);
    if (found == all.end()) throw UsageError{fmt::format("--input: \"{}\" is none of the uncertain inputs", key)};
    if (std::ranges::count(keys, key) > 1) throw UsageError{fmt::format("--input: \"{}\" stands twice", key)};
    if (!experiment::in_force(scenario, *found)) {
      throw UsageError{
          fmt::format("--input: \"{}\" is off in this scenario: it has no {}", key, key.substr(0, key.find('.')))};
    }
    some.push_back(*found);
  }
  return some;
}

/// None, and a remark, where the scenario's other values leave no room for this one.
std::optional<sim::Scenario> playable_with(const sim::Scenario& scenario, const std::string& key, double value) {
  try {
    return experiment::with(scenario, key, value);
  } catch (const std::invalid_argument& error) {
    warn(fmt::format("left out: {}", error.what()));
    return std::nullopt;
  }
}

/// The arms with another value of a setting.
std::vector<experiment::Arm> with(std::vector<experiment::Arm> arms, const std::string& key, double value) {
  for (experiment::Arm& arm : arms) arm.settings.policy = experiment::with(arm.settings.policy, key, value);
  return arms;
}

/// What the rows depend on besides the flags of play.
std::string all_arguments_of(const sim::Scenario& scenario, const std::vector<experiment::Arm>& arms,
                             const std::vector<experiment::UncertainInput>& inputs) {
  std::string text = arguments_of(scenario, arms) + "\n### inputs\n";
  for (const experiment::UncertainInput& input : inputs)
    text += fmt::format("{} = {}, {}\n", input.key, input.low, input.high);
  return text;
}

/// Plays the scenario as it is, then with each input at its two ends.
void play_inputs(experiment::SensitivityReport& report, StudyRun& run, const sim::Scenario& scenario,
                 const std::vector<experiment::Arm>& arms, const std::vector<experiment::UncertainInput>& inputs) {
  report.base = run.play(scenario, arms, "the scenario");
  for (const experiment::UncertainInput& input : inputs) {
    const bool setting = experiment::is_setting(input.key);
    experiment::PlayedInput played{input,
                                   setting ? experiment::value_of(arms.front().settings.policy, input.key)
                                           : experiment::value_of(scenario, input.key),
                                   {}};
    for (const double value : {input.low, input.high}) {
      if (value == played.value) continue;
      const std::string what = fmt::format("{} = {}", input.key, experiment::value_text(input.key, value));
      if (setting) {
        played.ends.push_back({value, run.play(scenario, with(arms, input.key, value), what)});
      } else if (const auto world = playable_with(scenario, input.key, value)) {
        played.ends.push_back({value, run.play(*world, arms, what)});
      }
    }
    report.inputs.push_back(std::move(played));
  }
  experiment::sort_by_change(report);
}

ExitCode study_sensitivity(const SensitivityFlags& flags) {
  require_writable(flags.study);
  const sim::Scenario scenario = flags.study.world.load();
  const std::vector<experiment::Arm> arms = experiment::arms_of(flags.arms, flags.base);
  const std::vector<experiment::UncertainInput> inputs =
      chosen(experiment::load_inputs(flags.table), flags.inputs, scenario);
  if (arms.size() < 2) throw UsageError{"--arms: two or more, each is compared with the one before it"};
  if (flags.goals && !scenario.keeper.enabled)
    throw UsageError{"--goals: this scenario has no keeper; see config/scenarios/keeper.toml"};
  experiment::SensitivityReport report{
      .played = flags.study.played(scenario),
      .measure = flags.goals ? experiment::Measure::kGoals : experiment::Measure::kPerOpportunity};
  for (const experiment::Arm& arm : arms) report.arms.push_back(arm.name);
  Study study = flags.study;
  study.draw_calibrations(scenario, flags.base);
  if (study.plan.calibrations.empty()) warn_of_shared_robots(scenario, arms);
  StudyRun run{study, "sensitivity", all_arguments_of(scenario, arms, inputs), arms.size() * (1 + 2 * inputs.size())};
  return run.run([&] { play_inputs(report, run, scenario, arms, inputs); }, [&] { give(study, report); });
}

}  // namespace

void add_study_sensitivity(CLI::App& study, int& exit_code) {
  auto* const verb = study.add_subcommand("sensitivity", "How far the comparison of policies rests on assumed inputs");
  const auto flags = std::make_shared<SensitivityFlags>();
  flags->study.plan.matches = 200;  // of each value
  verb->add_option("--arms", flags->arms, "Policies, each compared with the one before it")->capture_default_str();
  add_study_options(*verb, flags->study);
  add_svg_option(*verb, flags->study);
  add_arm_options(*verb, flags->base);
  verb->add_option("--inputs", flags->table, "Table of the inputs with their low and high values, and why")
      ->type_name("CSV")
      ->capture_default_str();
  verb->add_option("--input", flags->inputs, "Only these, e.g. kicker.delay_s,vision.latency_s")->delimiter(',');
  verb->add_flag("--goals", flags->goals, "Goals past the keeper instead of shots on target");
  verb->footer(
      "Each uncertain input of the scenario and each setting of the policies is set to a low and a high value\n"
      "(config/studies/sensitivity.csv says which and why), one at a time, and the same opportunities are played. "
      "Robots\n"
      "are not calibrated again. Inputs of the hand table matter to arms with it (@old) alone.");
  verb->callback([flags, &exit_code] { exit_code = study_sensitivity(*flags); });
}

}  // namespace trivela::cli
