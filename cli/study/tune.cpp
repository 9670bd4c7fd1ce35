#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/options/number_checks.hpp"
#include "cli/study/study_run.hpp"
#include "config/text/installation.hpp"
#include "experiment/study/tune/tune.hpp"

namespace trivela::cli {
namespace {

struct TuneFlags {
  std::string policy;
  std::vector<std::string> settings;
  int rounds = 4;
  std::string out;
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
      "trivela study tune {} --matches {} --possessions {} --calibrations {} --seed {} --held-out-seed {} --rounds {}",
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
std::string all_arguments_of(const experiment::TuneReport& report, const sim::Scenario& scenario,
                             const experiment::Arm& arm, std::uint64_t held_out_seed, int rounds) {
  std::string text = fmt::format("rounds = {}\nheld_out_seed = {}\n", rounds, held_out_seed) +
                     arguments_of(scenario, {arm}) + "\n### space\n";
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
  return {study.plan.seed, study.plan.matches, study.plan.possessions, study.plan.calibrations.size()};
}

/// Searches, and plays what was found, and what it began with, on other matches and calibrations.
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
}

/// Plays the shard's part of the next step that is not known yet.
ExitCode play_step(StudyRun& run, const TuneFlags& flags, const std::function<void()>& search) {
  bool ended = true;
  try {
    search();
  } catch (const StudyRun::Interrupted&) {
    run.keep();
    return kFailed;
  } catch (const StepPlayed&) {
    ended = false;
  }
  run.finish();
  const std::string shard = flags.study.shard->text();
  say(ended ? fmt::format(
                  "shard {}: the search has ended; this command with --out in place of --shard gives what it found\n",
                  shard)
            : fmt::format("shard {}: its part of this step is in {}; go on --with the results of all shards\n", shard,
                          flags.study.results));
  return ended ? kDone : kDoneWithLoss;
}

ExitCode write_best(StudyRun& run, const experiment::TuneReport& report, const TuneFlags& flags, bool interrupted) {
  if (report.state.tried == 0) {
    run.keep();
    return kFailed;
  }
  write_file(flags.out, experiment::to_settings_file(report, flags.out));
  say(to_text(report) + flags.out + "\n");
  if (!interrupted) {
    run.finish();
    return kDone;
  }
  warn(fmt::format("interrupted; {} has the best so far", flags.out));
  run.keep();
  return kFailed;
}

ExitCode study_tune(const TuneFlags& flags) {
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
  study.draw_calibrations(scenario, flags.base);
  other.draw_calibrations(scenario, flags.base);
  report.tuning = matches_of(study);
  report.held_out = matches_of(other);
  StudyRun run{study, "tune", all_arguments_of(report, scenario, arm, other.plan.seed, flags.rounds), 0};
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

void add_study_tune(CLI::App& study, int& exit_code) {
  auto* const verb = study.add_subcommand("tune", "Find a policy's best settings in a simulated world");
  const auto flags = std::make_shared<TuneFlags>();
  flags->study.plan.seed = 1001;  // other matches than those of the studies
  flags->study.plan.possessions = 20;
  flags->study.calibrations = 20;
  verb->add_option("policy", flags->policy, "Whose settings")
      ->required()
      ->check(CLI::IsMember(experiment::tuned_policies()));
  verb->add_option("--out", flags->out, "Settings file to write, for --config and for arms; required but for a shard")
      ->type_name("FILE");
  verb->add_option("--setting", flags->settings,
                   "Only these, in this order: KEY as in config/default.toml, or KEY=V1|V2 with other values");
  verb->add_option("--rounds", flags->rounds, "Times at most that each setting is looked at")
      ->check(CLI::Range(1, 20))
      ->capture_default_str();
  verb->add_option("--held-out-seed", flags->held_out_seed,
                   "Matches and calibrations of the final check; default the next")
      ->check(seeds());
  add_play_options(*verb, flags->study);
  add_arm_options(*verb, flags->base);
  verb->footer(
      "Coordinate search: each setting in turn gets the value with the most shots on target per opportunity, on the "
      "same\n"
      "matches and calibrations for all. Then the settings that were found are played on matches and calibrations that "
      "no\n"
      "choice was made by. Ctrl-C keeps the best so far (exit code 1). A shard plays its part of one step and ends "
      "with exit\n"
      "code 3, with 0 when the search has ended; give its next step the results of all shards (docs/studies.md).");
  verb->callback([flags, &exit_code] { exit_code = study_tune(*flags); });
}

}  // namespace trivela::cli
