#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/number_checks.hpp"
#include "cli/open_file.hpp"
#include "cli/study_run.hpp"
#include "cli/verbs.hpp"
#include "config/installation.hpp"
#include "config/scenario/scenario.hpp"
#include "experiment/tune/report.hpp"

namespace trivela::cli {
namespace {

struct TuneFlags {
  std::string policy;
  std::vector<std::string> settings;
  int rounds = 4;
  std::string out;
  std::string after;
  std::optional<std::uint64_t> held_out_seed;
  Study study;
  experiment::ArmBase base{config::shipped("default.toml").string(), {}, {}};
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
  const Study& study = flags.study;
  const experiment::PlayPlan& plan = study.plan;
  std::string text = fmt::format(
      "trivela tune {} --matches {} --possessions {} --calibrations {} --seed {} --held-out-seed {} --rounds {}",
      flags.policy, plan.matches, plan.possessions, study.calibrations, plan.seed, held_out_seed, flags.rounds);
  const TuneFlags defaults;
  if (study.world.file != defaults.study.world.file) text += " --scenario " + study.world.file;
  for (const std::string& line : study.world.changes) text += " --world '" + line + '\'';
  if (flags.base.config != defaults.base.config) text += " --config " + flags.base.config;
  for (const std::string& robot : flags.base.robots) text += " --robot " + robot;
  for (const std::string& line : flags.base.overrides) text += " --set '" + line + '\'';
  for (const std::string& setting : flags.settings) text += " --setting '" + setting + '\'';
  return text;
}

/// A shard has played its part of the step that the search is at; the next one depends on all parts.
struct StepPlayed {};

/// What the rows depend on besides the flags of play.
std::string arguments_of(const experiment::TuneReport& report, const sim::Scenario& scenario,
                         const experiment::Arm& arm, std::uint64_t held_out_seed, int rounds) {
  std::string text = fmt::format("rounds = {}\nheld_out_seed = {}\n", rounds, held_out_seed) +
                     config::to_toml_text(scenario) + "\n### arm\n" + experiment::describe(arm) + "\n### space\n";
  for (const experiment::Coordinate& coordinate : report.space)
    text += fmt::format("{}\n", fmt::join(coordinate.choices, "\n"));
  return text;
}

/// Plays arms that differ in their settings alone.
class Player {
 public:
  Player(StudyRun& run, const sim::Scenario& scenario, experiment::Arm arm)
      : run_(run), scenario_(scenario), arm_(std::move(arm)) {}

  std::vector<experiment::ArmTally> play(const std::vector<config::Settings>& settings,
                                         const experiment::PlayPlan& plan, const std::string& what) {
    std::vector<experiment::Arm> arms(settings.size(), arm_);
    for (std::size_t i = 0; i < settings.size(); ++i) arms[i].settings = settings[i];
    auto kept = run_.play_known(scenario_, arms, plan, what);
    if (!kept.whole) throw StepPlayed{};
    return std::move(kept.arms);
  }

 private:
  StudyRun& run_;
  const sim::Scenario& scenario_;
  experiment::Arm arm_;
};

experiment::TuneMatches matches_of(const Study& study) {
  return {study.plan.seed, study.plan.matches, study.plan.possessions, study.plan.evenings.size()};
}

/// Searches, and plays what was found, and what it began with, on other matches and evenings.
void search(experiment::TuneReport& report, Player& player, const Study& study, const Study& other, int rounds) {
  experiment::TuneState& state = report.state;
  const config::Settings start = state.settings;
  experiment::coordinate_search(
      report.space, rounds,
      [&](const std::vector<config::Settings>& settings) {
        return player.play(settings, study.plan,
                           fmt::format("{} settings tried, {} changed", state.tried, state.steps.size()));
      },
      state);
  auto played = player.play({start, state.settings}, other.plan, "held out");
  report.held_out_start = std::move(played[0]);
  report.held_out_best = std::move(played[1]);
}

void check(const TuneFlags& flags) {
  require_writable(flags.study);
  require_writable("--out", flags.out);
  if (flags.study.shard ? !flags.out.empty() : flags.out.empty())
    throw UsageError{flags.study.shard ? "--out and --shard: a part of the matches finds no settings"
                                       : "--out is required"};
  if (!flags.after.empty() && !flags.study.shard)
    throw UsageError{"--after: for --shard; without it --tallies goes on from a merged book"};
}

/// Plays the shard's part of the next step that is not known yet.
ExitCode play_step(StudyRun& run, const TuneFlags& flags, const std::function<void()>& search) {
  try {
    search();
  } catch (const StudyRun::Interrupted&) {
    run.keep();
    return kFailed;
  } catch (const StepPlayed&) {
    run.book().finish();
    say(fmt::format("shard {}: its part of this step is in {}; merge all shards and go on --after the merged book\n",
                    flags.study.shard->text(), flags.study.tallies));
    return kDoneWithLoss;
  }
  run.book().finish();
  say(
      fmt::format("shard {}: the search has ended; this command with --tallies {} and --out in place of --shard, "
                  "--after and its own --tallies gives what it found\n",
                  flags.study.shard->text(), flags.after.empty() ? flags.study.tallies : flags.after));
  return kDone;
}

ExitCode write_best(StudyRun& run, const experiment::TuneReport& report, const TuneFlags& flags, bool interrupted) {
  if (report.state.tried == 0) {
    run.keep();
    return kFailed;
  }
  write_file(flags.out, experiment::to_settings_file(report, flags.out));
  say(to_text(report) + flags.out + "\n");
  if (!interrupted) {
    run.book().finish();
    return kDone;
  }
  warn(fmt::format("interrupted; {} has the best so far", flags.out));
  run.keep();
  return kFailed;
}

ExitCode tune(const TuneFlags& flags) {
  check(flags);
  const sim::Scenario scenario = flags.study.world.load();
  experiment::Arm arm = experiment::arms_of(flags.policy, flags.base).front();
  experiment::check_playable(scenario, arm, flags.study.plan.possessions);
  Study study = flags.study, other = flags.study;
  other.plan.seed = flags.held_out_seed.value_or(study.plan.seed + 1);
  if (other.plan.seed == study.plan.seed) throw UsageError{"--held-out-seed: the same as --seed, nothing is held out"};
  experiment::TuneReport report{.policy = flags.policy,
                                .command = command_of(flags, other.plan.seed),
                                .scenario = study.scenario_name(),
                                .space = space_of(flags, *arm.policy),
                                .state = {.settings = arm.settings}};
  report.state.settings.run.scenario = study.world.file;  // whose best settings they are
  study.draw_evenings(scenario, flags.base);
  other.draw_evenings(scenario, flags.base);
  report.tuning = matches_of(study);
  report.held_out = matches_of(other);
  StudyRun run{study, "tune", arguments_of(report, scenario, arm, other.plan.seed, flags.rounds), 0};
  if (!flags.after.empty()) run.book().know(flags.after);
  Player player{run, scenario, std::move(arm)};
  const auto whole_search = [&] { search(report, player, study, other, flags.rounds); };
  if (study.shard) return play_step(run, flags, whole_search);
  try {
    whole_search();
  } catch (const StudyRun::Interrupted&) {
    return write_best(run, report, flags, true);
  }
  return write_best(run, report, flags, false);
}

}  // namespace

void add_tune(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("tune", "Find a policy's best settings in a simulated world");
  const auto flags = std::make_shared<TuneFlags>();
  flags->study.plan.seed = 1001;  // other matches than those of the studies
  flags->study.plan.possessions = 20;
  flags->study.calibrations = 20;
  verb->add_option("policy", flags->policy, "Whose settings")
      ->required()
      ->check(CLI::IsMember(experiment::tuned_policies()));
  verb->add_option("--out", flags->out, "Settings file to write, for --config and for arms; required but for a shard")
      ->type_name("FILE");
  verb->add_option("--after", flags->after, "With --shard: the merged book of all shards of the steps before")
      ->check(readable_file())
      ->type_name("FILE");
  verb->add_option("--setting", flags->settings,
                   "Only these, in this order: KEY as in config/default.toml, or KEY=V1|V2 with other values");
  verb->add_option("--rounds", flags->rounds, "Times at most that each setting is looked at")
      ->check(CLI::Range(1, 20))
      ->capture_default_str();
  verb->add_option("--held-out-seed", flags->held_out_seed, "Matches and evenings for the last word; default the next")
      ->check(seeds());
  add_play_options(*verb, flags->study);
  add_arm_options(*verb, flags->base);
  verb->footer(
      "Coordinate search: one setting after the other is set to the value with the most shots on target per\n"
      "opportunity, on the same matches and evenings for all; then those that were found are played on matches and\n"
      "evenings that no choice was made by. experiment/tune/space.cpp says which values are tried. Ctrl-C keeps the "
      "best so\n"
      "far (exit code 1). A shard plays its part of one step of the search and ends with exit code 3, with 0 when the\n"
      "search has ended: merge the shards after each, and give the merged book to the next (docs/scale.md).");
  verb->callback([flags, &exit_code] { exit_code = tune(*flags); });
}

}  // namespace trivela::cli
