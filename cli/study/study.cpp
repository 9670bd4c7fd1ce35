#include "cli/study/study.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "cli/options/number_checks.hpp"

namespace trivela::cli {

experiment::StudyPlayed StudyFlags::played(const sim::Scenario& scenario) const {
  return {.scenario = world.named(std::filesystem::path{world.file}.filename().string()),
          .seed = plan.seed,
          .matches = plan.matches,
          .possessions = plan.possessions,
          .calibrations = calibrations,
          .efficiency = blocked == "apart" ? experiment::Measure::kUnblocked : experiment::Measure::kEfficiency,
          .keeper = scenario.keeper.enabled};
}

void draw_calibrations(const sim::Scenario& scenario, const experiment::ArmBase& base, std::uint32_t calibrations,
                       experiment::PlayPlan& plan) {
  experiment::check_calibrations(base, calibrations, plan.matches);
  ProgressBar bar;
  plan.calibrations =
      experiment::calibrated_teams(scenario, calibrations, plan, [&](std::size_t done, std::size_t all) {
        bar.show(static_cast<double>(done), static_cast<double>(all), "calibrations", "calibration");
      });
}

void add_play_options(CLI::App& verb, StudyFlags& flags) {
  experiment::PlayPlan& plan = flags.plan;
  add_default(verb, "--matches", plan.matches, "Matches of each arm", CLI::Range(2, 1000000));
  add_default(verb, "--possessions", plan.possessions, "Opportunities of a match", CLI::Range(1, 10000));
  add_default(verb, "--seed", plan.seed, "Same seed, same opportunities", seeds());
  verb.add_option("--jobs", plan.jobs, "Threads; default one a core")->check(CLI::Range(1, 256));
  add_world_options(verb, flags.world, &flags.calibrations);
  verb.add_option("--results", flags.results,
                  "File that keeps what is played, match by match; one of the same command is continued")
      ->type_name("FILE");
  verb.add_option("--with", flags.with,
                  "Results of other runs or shards of this study: nothing of them is played again")
      ->type_name("FILE");
  add_shard_option(verb, plan.shard, "without --shard and --with their --results the report is of all");
  add_arm_options(verb, flags.base);
}

void add_arm_options(CLI::App& verb, experiment::ArmBase& base) {
  base.dashes = "--";
  verb.add_option("--robot", base.robots, "Robot files, one for each of the team; default: the calibrated ones")
      ->delimiter(',');
  add_default(verb, "--config", base.config, "Settings of the nodes");
  verb.add_option("--set", base.overrides, "One setting on top, e.g. --set policy.settle_s=0.5");
}

void StudyFlags::require_writable() const {
  const auto& shard = plan.shard;
  check_shard(shard, plan.matches);
  if (shard && results.empty())
    throw UsageError{fmt::format("--shard {}: --results FILE is where its part is kept", shard->text())};
  if (shard && (json || !csv.empty() || !svg.empty()))
    throw UsageError{
        fmt::format("--shard {}: a part has no report; without --shard and --with the results of all parts "
                    "there is one",
                    shard->text())};
  cli::require_writable("--results", results, true);
  cli::require_writable("--csv", csv);
  cli::require_writable("--svg", svg);
}

StudyRun::StudyRun(const StudyFlags& flags, const std::string& name, const std::string& arguments)
    : flags_(flags),
      name_(name),
      results_(flags.results, fmt::format("program = {}\nstudy = {}\nseed = {}\nmatches = {}\npossessions = {}\n"
                                          "calibrations = {}\n{}",
                                          config::software_version(), name, flags.plan.seed, flags.plan.matches,
                                          flags.plan.possessions, flags.plan.calibrations.size(), arguments)) {
  for (const std::string& file : flags.with) results_.take_over(file);
  if (const auto known = results_.size(); known > 0 && !flags.json)
    fmt::print(stderr, "trivela: the results of {} matches are known already\n", known);
}

experiment::KnownPlay StudyRun::play(const std::vector<experiment::StudyWorld>& worlds,
                                     const experiment::PlayPlan& plan) {
  bar_.restart();
  auto known =
      experiment::play_missing(worlds, plan, results_, [&](std::size_t done, std::size_t all, const std::string& what) {
        if (all > 0) bar_.show(static_cast<double>(done), static_cast<double>(all), "matches", what);
        if (StopRequest::asked()) throw Interrupted{};
      });
  results_.commit();
  return known;
}

ExitCode StudyRun::keep() {
  bar_.end();
  const auto matches = results_.size();
  std::string file = flags_.results, command = "the same command";
  if (file.empty() && matches > 0) {
    file = name_ + ".results";
    for (int n = 2; std::filesystem::exists(file); ++n) file = fmt::format("{}-{}.results", name_, n);
    results_.save(file);
    command += " with --results " + file;
  }
  results_.commit();
  warn(matches > 0 ? fmt::format("interrupted; {} matches are in {}: {} goes on from there", matches, file, command)
                   : "interrupted before a match was played");
  return kFailed;
}

void add_study(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("study", "Compare arms, worlds and settings in many simulated matches");
  verb->require_subcommand(1);
  for (const auto add : {add_questions, add_study_tune, add_evaluate_policy, add_learn}) add(*verb, exit_code);
}

}  // namespace trivela::cli
