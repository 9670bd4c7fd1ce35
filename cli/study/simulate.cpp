#include <fmt/format.h>

#include <filesystem>

#include "cli/launch/progress_bar.hpp"
#include "cli/launch/signals.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/options/play_options.hpp"
#include "cli/study/study.hpp"
#include "cli/verbs.hpp"
#include "config/text/installation.hpp"
#include "experiment/run/arms.hpp"
#include "experiment/run/experiment.hpp"

namespace trivela::cli {
namespace {

struct SimulateFlags {
  std::string arms;
  experiment::PlayPlan plan{.matches = 100};
  experiment::PlayOptions options;
  std::uint32_t calibrations = 0;
  std::string out = "ab.db";
  World world;
  experiment::ArmBase base{config::shipped("default.toml").string(), {}, {}};
};

experiment::ExperimentRun play(const experiment::ExperimentPlan& plan, const SimulateFlags& flags) {
  const StopRequest stop;
  ProgressBar bar;
  const auto found = [&](std::int64_t matches) {
    if (matches > 0) fmt::print("{} of {} matches are in {} already\n", matches, plan.range().size(), flags.out);
  };
  const auto progress = [&](double done, double total, const std::string& what) { bar.show(done, total, what); };
  return experiment::run_experiment(plan, flags.out, {found, progress, [] { return StopRequest::asked(); }});
}

int simulate(const SimulateFlags& flags) {
  require_writable("--out", flags.out, true);
  check_shard(flags.plan.shard, flags.plan.matches);
  experiment::ExperimentPlan plan{flags.plan};
  plan.scenario = flags.world.load();
  flags.world.require_effect({plan.scenario});
  plan.scenario_name = flags.world.named(std::filesystem::path{flags.world.file}.stem().string());
  plan.arms = experiment::arms_of(flags.arms, flags.base);
  plan.options = flags.options;
  draw_calibrations(plan.scenario, flags.base, flags.calibrations, plan);
  if (plan.calibrations.empty())
    for (const std::string& remark : experiment::shared_robots(plan.scenario, plan.arms)) warn(remark);
  experiment::check_playable(plan);  // a plan that is refused leaves no log
  const experiment::ExperimentRun run = play(plan, flags);
  if (run.complete) {
    fmt::print("{}", to_text(plan, run, flags.out));
    if (plan.shard)
      fmt::print("shard {}: matches {} to {} of {}; trivela merge OUT SHARD... makes one log of all shards\n",
                 plan.shard->text(), plan.range().begin, plan.range().end - 1, plan.matches);
    return kDone;
  }
  fmt::print(stderr, "trivela: interrupted; {} of {} matches are in {}: the same command goes on from there\n",
             run.in_log, plan.range().size(), flags.out);
  return kFailed;
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_code) {
  const auto [verb, flags] =
      add_verb(app, exit_code, "simulate", "Play many matches in this process, the same ones with every arm", simulate);
  verb->footer(
      "Possession n of match m is the same situation with the same noise for every arm: what differs is what the arms\n"
      "did. The log is a match log with a session for each match and arm. A run that was stopped, however it was, goes "
      "on when\n"
      "the same command is given again.");
  verb->add_option("--arms", flags->arms,
                   "policies, e.g. stopped,stopped@old,moving,predictive,oracle, or a file of arms (.toml)")
      ->required();
  add_default(*verb, "--matches", flags->plan.matches, "matches of each arm", CLI::Range(1u, 1u << 20));
  add_default(*verb, "--possessions", flags->plan.possessions, "opportunities of a match", CLI::Range(1u, 100000u));
  add_default(*verb, "--seed", flags->plan.seed, "same seed, same matches", seeds());
  add_default(*verb, "--jobs", flags->plan.jobs, "threads; the rows do not depend on it", CLI::Range(1u, 1024u));
  add_default(*verb, "--out", flags->out, "match log, new or of the same command");
  add_shard_option(*verb, flags->plan.shard, "trivela merge makes one log of their logs");
  add_world_options(*verb, flags->world, &flags->calibrations);
  add_arm_options(*verb, flags->base);
  verb->add_flag("--shadows", flags->options.shadows, "record what the other policies would have done");
  verb->add_flag("--every-cycle", flags->options.every_cycle, "record every decision, not only those that fire");
}

}  // namespace trivela::cli
