#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "cli/options/number_checks.hpp"
#include "cli/study/study.hpp"
#include "experiment/study/tune/tune.hpp"

namespace trivela::cli {
namespace {

struct TuneFlags : StudyFlags {
  std::string policy;
  std::vector<std::string> settings;
  int rounds = 4;
  std::string out;
  std::optional<std::uint64_t> held_out_seed;
};

std::vector<experiment::Coordinate> space_of(const TuneFlags& flags, kicking::PolicyName policy) {
  std::vector<experiment::Coordinate> all = experiment::tuned_space(policy);
  if (flags.settings.empty()) return all;
  std::vector<experiment::Coordinate> named;
  for (const std::string& text : flags.settings) {
    named.push_back(experiment::coordinate_of(text, all, "--setting"));
    if (std::ranges::count(named, named.back().name, &experiment::Coordinate::name) > 1)
      throw UsageError{fmt::format("--setting {}: stands twice", named.back().name)};
  }
  return named;
}

/// The command that does the same again, for the file.
std::string command_of(const TuneFlags& flags, std::uint64_t held_out_seed) {
  std::string text = fmt::format(
      "trivela study tune {} --matches {} --possessions {} --calibrations {} --seed {} --held-out-seed {} --rounds {}",
      flags.policy, flags.plan.matches, flags.plan.possessions, flags.calibrations, flags.plan.seed, held_out_seed,
      flags.rounds);
  const TuneFlags defaults;
  if (flags.world.file != defaults.world.file) text += " --scenario " + flags.world.file;
  for (const std::string& line : flags.world.changes) text += " --world '" + line + '\'';
  if (flags.base.config != defaults.base.config) text += " --config " + flags.base.config;
  for (const std::string& robot : flags.base.robots) text += " --robot " + robot;
  for (const std::string& line : flags.base.overrides) text += " --set '" + line + '\'';
  for (const std::string& setting : flags.settings) text += " --setting '" + setting + '\'';
  return text;
}

/// A shard has played its part of the step that the search is at; the next one depends on all parts.
struct StepPlayed {};

ExitCode say_step(StudyRun& run, const TuneFlags& flags, bool ended) {
  run.finish();
  say(fmt::format(
      "shard {}: {}\n", flags.plan.shard->text(),
      ended ? "the search has ended; this command with --out in place of --shard gives what it found"
            : fmt::format("its part of this step is in {}; go on --with the results of all shards", flags.results)));
  return ended ? kDone : kDoneWithLoss;
}

/// Searches, and plays what was found, and what it began with, on other matches and calibrations.
ExitCode search(StudyRun& run, experiment::Tuning& tuning, experiment::StudyWorld world, const TuneFlags& flags,
                const experiment::PlayPlan& held_out) {
  const config::Settings start = tuning.settings;
  const experiment::Arm arm = world.arms.front();
  const auto play = [&](const experiment::PlayPlan& plan, const std::vector<config::Settings>& settings) {
    world.arms.assign(settings.size(), arm);
    for (std::size_t i = 0; i < settings.size(); ++i) world.arms[i].settings = settings[i];
    const auto known = run.play({world}, plan);
    if (!known.whole) throw StepPlayed{};
    std::vector<experiment::ArmTally> tallies;
    for (const experiment::StudyRow& row : known.rows) tallies.push_back(row.matches);
    return tallies;
  };
  const auto step = [&](const std::vector<config::Settings>& settings) {
    world.what = fmt::format("{} settings tried, {} changed", tuning.tried, tuning.steps.size());
    return play(flags.plan, settings);
  };
  bool interrupted = false;
  try {
    experiment::coordinate_search(flags.rounds, step, tuning);
    world.what = "held out";
    tuning.held_out_played = play(held_out, {start, tuning.settings});
    if (flags.plan.shard) return say_step(run, flags, true);
  } catch (const StepPlayed&) {
    return say_step(run, flags, false);
  } catch (const StudyRun::Interrupted&) {
    interrupted = true;
  }
  run.finish();
  if (!flags.plan.shard && tuning.tried > 0) {
    write_file(flags.out, experiment::to_settings_file(tuning, flags.out));
    say(to_text(tuning) + flags.out + "\n");
    if (interrupted) warn(fmt::format("interrupted; {} has the best so far", flags.out));
  }
  return interrupted ? run.keep() : kDone;
}

int study_tune(const TuneFlags& asked) {
  TuneFlags flags = asked;
  flags.require_writable();
  require_writable("--out", flags.out);
  if (flags.plan.shard && !flags.out.empty())
    throw UsageError{"--out and --shard: a part of the matches finds no settings"};
  if (!flags.plan.shard && flags.out.empty()) throw UsageError{"--out is required"};
  const sim::Scenario scenario = flags.world.load();
  flags.world.require_effect({scenario});
  const experiment::Arm arm = experiment::arms_of(flags.policy, flags.base).front();
  experiment::check_playable(scenario, arm, flags.plan.possessions);
  TuneFlags other = flags;
  other.plan.seed = flags.held_out_seed.value_or(flags.plan.seed + 1);
  if (other.plan.seed == flags.plan.seed) throw UsageError{"--held-out-seed: the same as --seed, nothing is held out"};
  experiment::Tuning tuning{.policy = flags.policy,
                            .command = command_of(flags, other.plan.seed),
                            .tuning = flags.played(scenario),
                            .held_out = other.played(scenario),
                            .space = space_of(flags, *arm.policy),
                            .settings = arm.settings};
  tuning.settings.run.scenario = flags.world.file;  // whose best settings they are
  for (TuneFlags* const played : {&flags, &other})
    draw_calibrations(scenario, played->base, played->calibrations, played->plan);
  const experiment::StudyWorld world{"tune", scenario, {arm}};
  std::string arguments = fmt::format("rounds = {}\nheld_out_seed = {}\n", flags.rounds, other.plan.seed) +
                          experiment::arguments_of({.name = "tune", .whom = "", .worlds = {world}});
  for (const experiment::Coordinate& coordinate : tuning.space)
    for (const experiment::Choice& choice : coordinate.choices)
      arguments += fmt::format("{}\n", fmt::join(choice, "\n"));
  StudyRun run{flags, "tune", arguments};
  return search(run, tuning, world, flags, other.plan);
}

}  // namespace

void add_study_tune(CLI::App& study, int& exit_code) {
  const auto [verb, flags] =
      add_verb(study, exit_code, "tune", "Find a policy's best settings in a simulated world", study_tune);
  flags->plan.seed = 1001;  // other matches than those of the studies
  flags->plan.possessions = 20;
  flags->calibrations = 20;
  verb->add_option("policy", flags->policy, "Whose settings")
      ->required()
      ->check(CLI::IsMember(experiment::tuned_policies()));
  verb->add_option("--out", flags->out, "Settings file to write, for --config and for arms; required but for a shard")
      ->type_name("FILE");
  verb->add_option("--setting", flags->settings,
                   "Only these, in this order: KEY as in config/default.toml, or KEY=V1|V2 with other values");
  add_default(*verb, "--rounds", flags->rounds, "Times at most that each setting is looked at", CLI::Range(1, 20));
  verb->add_option("--held-out-seed", flags->held_out_seed,
                   "Matches and calibrations of the final check; default the next")
      ->check(seeds());
  add_play_options(*verb, *flags);
  verb->footer(
      "Each setting in turn gets the value with the most shots on target per opportunity; what was found is then "
      "played\n"
      "on other matches and calibrations. Ctrl-C keeps the best so far (exit code 1). A shard plays its part of one "
      "step\n"
      "and ends with exit code 3, with 0 when the search has ended (docs/studies.md).");
}

}  // namespace trivela::cli
