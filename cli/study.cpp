#include "cli/study.hpp"

#include <filesystem>

#include "cli/launch/progress_bar.hpp"
#include "cli/number_checks.hpp"
#include "cli/shard_option.hpp"
#include "cli/verbs.hpp"

namespace trivela::cli {

std::string Study::scenario_name() const { return world.named(std::filesystem::path{world.file}.filename().string()); }

void Study::draw_evenings(const sim::Scenario& scenario, const experiment::ArmBase& base) {
  plan.evenings = cli::draw_evenings(scenario, base, {calibrations, plan.seed, plan.jobs}, plan.matches);
}

std::vector<experiment::Team> draw_evenings(const sim::Scenario& scenario, const experiment::ArmBase& base,
                                            const experiment::EveningPlan& plan, std::uint32_t matches) {
  if (plan.evenings > 0 && !base.robots.empty()) {
    throw UsageError{fmt::format(
        "--robot and --calibrations {}: robots are those of files or of evenings; leave one out (--calibrations 0)",
        plan.evenings)};
  }
  if (plan.evenings > matches)
    throw UsageError{fmt::format("--calibrations {}: more evenings than --matches {}", plan.evenings, matches)};
  ProgressBar bar;
  return experiment::teams_of_evenings(scenario, plan, [&](std::size_t done, std::size_t all) {
    bar.show(static_cast<double>(done), static_cast<double>(all), "evenings", "calibration");
  });
}

void warn_of_shared_robots(const sim::Scenario& scenario, const std::vector<experiment::Arm>& arms) {
  for (const std::string& remark : experiment::shared_robots(scenario, arms)) warn(remark);
}

void add_play_options(CLI::App& verb, Study& study) {
  experiment::PlayPlan& plan = study.plan;
  verb.add_option("--matches", plan.matches, "Matches of each arm")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  verb.add_option("--possessions", plan.possessions, "Opportunities of a match")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  verb.add_option("--seed", plan.seed, "Same seed, same opportunities")->check(seeds())->capture_default_str();
  verb.add_option("--jobs", plan.jobs, "Threads; default one a core")->check(CLI::Range(1, 256));
  add_world_options(verb, study.world);
  add_calibrations_option(verb, study.calibrations);
  verb.add_option(
          "--tallies", study.tallies,
          "Book that keeps what is played, match by match, new or of the same command, which goes on from there")
      ->type_name("FILE");
  add_shard_option(verb, study.shard, "trivela merge makes one book of their --tallies");
}

void add_calibrations_option(CLI::App& verb, std::uint32_t& calibrations) {
  verb.add_option(
          "--calibrations", calibrations,
          "Evenings of calibration that are played for the robots, match m with evening m mod K; 0: robot files")
      ->check(CLI::Range(0u, 1000u))
      ->capture_default_str()
      ->type_name("K");
}

void add_study_options(CLI::App& verb, Study& study) {
  add_play_options(verb, study);
  verb.add_option("--csv", study.csv, "Everything that was counted as CSV")->type_name("FILE");
  verb.add_option("--svg", study.svg, "A chart")->type_name("FILE");
  verb.add_flag("--json", study.json, "JSON instead of text");
}

void add_arm_options(CLI::App& verb, experiment::ArmBase& base) {
  base.arms_called = "--arms";
  base.set_called = "--set";
  verb.add_option("--robot", base.robots, "Robot files, one for each of the team; default: the calibrated ones");
  verb.add_option("--config", base.config, "Settings of the nodes")->capture_default_str();
  verb.add_option("--set", base.overrides, "One setting on top, e.g. --set policy.settle_s=0.5");
}

void require_writable(const Study& study) {
  if (!study.csv.empty() && study.csv == study.svg)
    throw UsageError{fmt::format("--csv and --svg are the same file: {}", study.csv)};
  check_shard(study.shard, study.plan.matches);
  if (study.shard && study.tallies.empty())
    throw UsageError{fmt::format("--shard {}: --tallies FILE is where its part is kept", study.shard->text())};
  if (study.shard && (study.json || !study.csv.empty() || !study.svg.empty()))
    throw UsageError{
        fmt::format("--shard {}: a part has no report; the merged book of all parts has", study.shard->text())};
  require_writable("--tallies", study.tallies, true);
  require_writable("--csv", study.csv);
  require_writable("--svg", study.svg);
}

}  // namespace trivela::cli
