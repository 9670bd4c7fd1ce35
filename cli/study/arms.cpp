#include <memory>

#include "cli/study/study_run.hpp"
#include "config/text/installation.hpp"
#include "experiment/study/arms_report.hpp"

namespace trivela::cli {
namespace {

struct ArmsFlags {
  std::string arms = "stopped@old,stopped,moving,predictive";
  Study study;
  experiment::ArmBase base{config::shipped("default.toml").string(), {}, {}};
};

ExitCode study_arms(const ArmsFlags& flags) {
  require_writable(flags.study);
  const sim::Scenario scenario = flags.study.world.load();
  const std::vector<experiment::Arm> arms = experiment::arms_of(flags.arms, flags.base);
  Study study = flags.study;
  study.draw_calibrations(scenario, flags.base);
  if (study.plan.calibrations.empty()) warn_of_shared_robots(scenario, arms);
  for (const experiment::Arm& arm : arms) experiment::check_playable(scenario, arm, study.plan.possessions);
  StudyRun run{study, "arms", arguments_of(scenario, arms), arms.size()};
  experiment::ArmsReport report{.played = study.played(scenario)};
  const auto play = [&] {
    auto played = run.play(scenario, arms, "the arms");
    for (std::size_t i = 0; i < arms.size(); ++i) report.arms.push_back({arms[i].name, std::move(played[i])});
  };
  return run.run(play, [&] { give(study, report); });
}

}  // namespace

void add_study_arms(CLI::App& study, int& exit_code) {
  auto* const verb = study.add_subcommand("arms", "Arms on the same matches, each compared with the first");
  const auto flags = std::make_shared<ArmsFlags>();
  verb->add_option("--arms", flags->arms, "Policies, e.g. stopped,moving,predictive, or a file of arms (.toml)")
      ->capture_default_str();
  add_study_options(*verb, flags->study);
  add_arm_options(*verb, flags->base);
  verb->footer(
      "As `trivela simulate`, but it keeps the counts of each match alone, 1.3 bytes an opportunity in place of 650: "
      "no\n"
      "decisions, distances, crossings or pairs of opportunities.");
  verb->callback([flags, &exit_code] { exit_code = study_arms(*flags); });
}

}  // namespace trivela::cli
