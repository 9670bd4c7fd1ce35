#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/study/study_run.hpp"
#include "config/scenario/scenario.hpp"
#include "config/scenario/worlds.hpp"
#include "config/text/installation.hpp"
#include "experiment/study/robustness.hpp"

namespace trivela::cli {
namespace {

struct RobustnessFlags {
  std::string arms = config::shipped("arms/robustness.toml").string();
  std::string rival = "moving";
  std::string worlds = config::shipped("studies/robustness.toml").string();
  std::vector<std::string> only;
  Study study;
  experiment::ArmBase base{config::shipped("default.toml").string(), {}, {}};
};

std::vector<config::NamedWorld> chosen(std::vector<config::NamedWorld> all, const std::vector<std::string>& names) {
  if (names.empty()) return all;
  std::vector<config::NamedWorld> some;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(all, name, &config::NamedWorld::name);
    if (found == all.end()) throw UsageError{fmt::format("--only: \"{}\" is none of the worlds", name)};
    if (std::ranges::count(names, name) > 1) throw UsageError{fmt::format("--only: \"{}\" stands twice", name)};
    some.push_back(*found);
  }
  return some;
}

ExitCode study_robustness(const RobustnessFlags& flags) {
  require_writable(flags.study);
  const sim::Scenario scenario = flags.study.world.load();
  const std::vector<experiment::Arm> arms = experiment::arms_of(flags.arms, flags.base);
  experiment::RobustnessReport report{.played = flags.study.played(scenario)};
  for (const experiment::Arm& arm : arms) report.arms.push_back(arm.name);
  const auto rival = std::ranges::find(report.arms, flags.rival);
  if (rival == report.arms.end()) throw UsageError{fmt::format("--rival: \"{}\" is none of the arms", flags.rival)};
  if (arms.size() < 2) throw UsageError{"--arms: two or more, all are compared with one"};
  report.rival = static_cast<std::size_t>(rival - report.arms.begin());
  const auto worlds = chosen(config::load_worlds(flags.worlds, scenario), flags.only);
  Study study = flags.study;
  study.draw_calibrations(scenario, flags.base);
  std::string arguments = arguments_of(scenario, arms) + "\n### worlds\n";
  for (const config::NamedWorld& world : worlds) arguments += world.name + "\n" + config::to_toml_text(world.scenario);
  StudyRun run{study, "robustness", arguments, arms.size() * worlds.size()};
  const auto play = [&] {
    for (const config::NamedWorld& world : worlds)
      report.worlds.push_back({world.name, world.why, run.play(world.scenario, arms, world.name)});
  };
  return run.run(play, [&] { give(study, report); });
}

}  // namespace

void add_study_robustness(CLI::App& study, int& exit_code) {
  auto* const verb = study.add_subcommand("robustness", "How policies stand worlds that robots do not expect");
  const auto flags = std::make_shared<RobustnessFlags>();
  flags->study.plan.matches = 200;  // of each arm and world
  verb->add_option("--arms", flags->arms, "Policies, or a file of arms (.toml)")->capture_default_str();
  verb->add_option("--rival", flags->rival, "The arm that the others are compared with")->capture_default_str();
  verb->add_option("--worlds", flags->worlds, "File of the worlds")->type_name("TOML")->capture_default_str();
  verb->add_option("--only", flags->only, "Only these worlds, e.g. keeper,\"twice the drag\"")->delimiter(',');
  add_study_options(*verb, flags->study);
  add_svg_option(*verb, flags->study);
  add_arm_options(*verb, flags->base);
  verb->footer(
      "Each world of config/studies/robustness.toml is played by every arm, on the same opportunities. Robots are\n"
      "calibrated in the study's scenario (--calibrations) and not again. The arms of config/arms/robustness.toml\n"
      "decide by the robots' files, and by what their kicks have shown (self_calibration.mode = \"on\").");
  verb->callback([flags, &exit_code] { exit_code = study_robustness(*flags); });
}

}  // namespace trivela::cli
