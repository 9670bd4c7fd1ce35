#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

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
  std::uint32_t matches = 100;
  std::uint32_t possessions = 60;
  std::uint32_t calibrations = 0;
  std::uint64_t seed = 1;
  unsigned jobs = 1;
  std::string out = "ab.db";
  World world;
  experiment::ArmBase base{config::shipped("default.toml").string(), {}, {}};
  bool shadows = false;
  bool every_cycle = false;
  std::optional<log::Shard> shard;
};

experiment::ExperimentRun play(const experiment::ExperimentPlan& plan, const SimulateFlags& flags) {
  const StopRequest stop;
  ProgressBar bar;
  const auto found = [&](std::int64_t matches) {
    if (matches > 0) fmt::print("{} of {} matches are in {} already\n", matches, plan.range().size(), flags.out);
  };
  const auto progress = [&](double done, double total, const std::string& what) { bar.show(done, total, what); };
  return experiment::run_experiment(plan, flags.jobs, flags.out,
                                    {found, progress, [] { return StopRequest::asked(); }});
}

int simulate(const SimulateFlags& flags) {
  require_writable("--out", flags.out, true);
  check_shard(flags.shard, flags.matches);
  experiment::ExperimentPlan plan;
  plan.scenario = flags.world.load();
  flags.world.require_effect({plan.scenario});
  plan.scenario_name = flags.world.named(std::filesystem::path{flags.world.file}.stem().string());
  plan.arms = experiment::arms_of(flags.arms, flags.base);
  plan.seed = flags.seed;
  plan.matches = flags.matches;
  plan.possessions = flags.possessions;
  plan.shard = flags.shard;
  plan.options = {.shadows = flags.shadows, .every_cycle = flags.every_cycle};
  plan.calibrations =
      draw_calibrations(plan.scenario, flags.base, {flags.calibrations, flags.seed, flags.jobs}, flags.matches);
  if (plan.calibrations.empty())
    for (const std::string& remark : experiment::shared_robots(plan.scenario, plan.arms)) warn(remark);
  experiment::check_playable(plan);  // a plan that is refused leaves no log
  const experiment::ExperimentRun run = play(plan, flags);
  if (run.complete) {
    fmt::print("{}", to_text(plan, run, flags.jobs, flags.out));
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
  auto* verb = app.add_subcommand("simulate", "Play many matches in this process, the same ones with every arm");
  verb->footer(
      "Possession n of match m is the same situation with the same noise for every arm: what differs is what the arms\n"
      "did. The log is a match log with a session for each match and arm. A run that was stopped, however it was, goes "
      "on when\n"
      "the same command is given again.");
  auto flags = std::make_shared<SimulateFlags>();
  verb->add_option("--arms", flags->arms,
                   "policies, e.g. stopped,stopped@old,moving,predictive,oracle, or a file of arms (.toml)")
      ->required();
  verb->add_option("--matches", flags->matches, "matches of each arm")
      ->check(CLI::Range(1u, 1u << 20))
      ->capture_default_str();
  verb->add_option("--possessions", flags->possessions, "opportunities of a match")
      ->check(CLI::Range(1u, 100000u))
      ->capture_default_str();
  verb->add_option("--seed", flags->seed, "same seed, same matches")->check(seeds())->capture_default_str();
  verb->add_option("--jobs", flags->jobs, "threads; the rows do not depend on it")
      ->check(CLI::Range(1u, 1024u))
      ->capture_default_str();
  verb->add_option("--out", flags->out, "match log, new or of the same command")->capture_default_str();
  add_shard_option(*verb, flags->shard, "trivela merge makes one log of their logs");
  add_world_options(*verb, flags->world);
  add_calibrations_option(*verb, flags->calibrations);
  add_arm_options(*verb, flags->base);
  verb->add_flag("--shadows", flags->shadows, "record what the other policies would have done");
  verb->add_flag("--every-cycle", flags->every_cycle, "record every decision, not only those that fire");
  verb->callback([flags, &exit_code] { exit_code = simulate(*flags); });
}

}  // namespace trivela::cli
