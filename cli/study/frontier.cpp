#include <memory>

#include "cli/study/study_run.hpp"
#include "config/text/installation.hpp"
#include "experiment/study/frontier.hpp"

namespace trivela::cli {
namespace {

struct FrontierFlags {
  std::string policy = "predictive";
  std::vector<double> thresholds{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95};
  std::string beside = config::shipped("arms/baselines.toml").string();
  Study study;
  experiment::ArmBase base{config::shipped("default.toml").string(), {}, {}};
};

experiment::FrontierReport report_of(const std::string& policy, const experiment::StudyPlayed& how,
                                     const std::vector<double>& thresholds, const std::vector<experiment::Arm>& arms,
                                     std::vector<experiment::ArmTally> played) {
  experiment::FrontierReport report{.policy = policy, .played = how};
  const std::size_t n = thresholds.size();
  for (std::size_t i = 0; i < n; ++i) report.points.push_back({thresholds[i], std::move(played[i])});
  for (std::size_t i = n; i + 1 < arms.size(); ++i) report.fixed.push_back({arms[i].name, std::move(played[i])});
  report.oracle = experiment::FixedPoint{arms.back().name, std::move(played.back())};
  return report;
}

ExitCode study_frontier(const FrontierFlags& flags) {
  require_writable(flags.study);
  const sim::Scenario scenario = flags.study.world.load();
  const std::vector<double> thresholds = sorted(flags.thresholds);
  std::vector<experiment::Arm> arms;
  for (const double threshold : thresholds) {
    experiment::Arm arm = experiment::arms_of(flags.policy, flags.base).front();
    arm.settings.policy.predictive.threshold = threshold;
    arms.push_back(std::move(arm));
  }
  for (const std::string& text : {flags.beside, std::string{"oracle"}}) {
    for (experiment::Arm& arm : experiment::arms_of(text, flags.base)) arms.push_back(std::move(arm));
  }
  Study study = flags.study;
  study.draw_calibrations(scenario, flags.base);
  if (study.plan.calibrations.empty()) warn_of_shared_robots(scenario, arms);
  StudyRun run{study, "frontier", arguments_of(scenario, arms), arms.size()};
  std::vector<experiment::ArmTally> played;
  return run.run(
      [&] { played = run.play(scenario, arms, "the frontier"); },
      [&] { give(study, report_of(flags.policy, study.played(scenario), thresholds, arms, std::move(played))); });
}

}  // namespace

void add_study_frontier(CLI::App& study, int& exit_code) {
  auto* const verb =
      study.add_subcommand("frontier", "Efficiency against volume, swept over a policy's firing threshold");
  const auto flags = std::make_shared<FrontierFlags>();
  verb->add_option("--policy", flags->policy, "Which is swept")
      ->check(CLI::IsMember(kicking::policies_where(
          [](const auto& policy) { return policy.kind == kicking::PolicyKind::kPredictive && !policy.needs_truth(); })))
      ->capture_default_str();
  verb->add_option("--threshold", flags->thresholds, "Least probabilities of a ball on target that it fires at")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  verb->add_option("--beside", flags->beside, "Arms beside the frontier: policies, or a file of arms (.toml)")
      ->capture_default_str();
  add_study_options(*verb, flags->study);
  add_svg_option(*verb, flags->study);
  add_arm_options(*verb, flags->base);
  verb->footer(
      "Beside the frontier, on the same opportunities: stopped and moving with their best settings and with the\n"
      "paper's, and oracle. Whether a policy lies below the frontier is asked at its own number of kicks, the "
      "frontier\n"
      "being linear between thresholds.");
  verb->callback([flags, &exit_code] { exit_code = study_frontier(*flags); });
}

}  // namespace trivela::cli
