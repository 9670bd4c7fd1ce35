// The studies that are arms in worlds: flags, and what they play of them. They end in ask().
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "cli/calibrate/robot_file.hpp"
#include "cli/study/study.hpp"
#include "config/scenario/scenario.hpp"
#include "evaluator/render/json_values.hpp"
#include "experiment/study/studies.hpp"

namespace trivela::cli {
namespace {

using experiment::arms_of;
using experiment::Study;
using sim::Scenario;

/// The flags of the studies; each has some of them.
struct QuestionFlags : StudyFlags {
  std::string arms = "stopped@old,stopped,moving,predictive";
  std::set<double> opponent_medians_m{0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0};
  std::set<double> eye_biases_m{0.0, 0.1, 0.15};
  std::string law = "released";
  bool no_sweep = false;
  std::string policy = "predictive";
  std::set<double> thresholds{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95};
  std::string beside = config::shipped("arms/baselines.toml").string();
  std::string rival = "moving";
  std::string table;               ///< file of the worlds or inputs
  std::vector<std::string> named;  ///< of the table; empty: all
  bool goals = false;
};

/// A study by its verb.
struct Question {
  const char* name;
  const char* asks;
  const char* more;
  void (*add_options)(CLI::App& verb, QuestionFlags& flags);
  Study (*study)(const QuestionFlags& flags, const Scenario& scenario);
};

/// Those of all that have one of the names; without names all. Throws UsageError naming the flag and the name.
template <class T>
std::vector<T> chosen(const std::vector<T>& all, const std::vector<std::string>& names, std::string T::*name,
                      const char* flag, const char* what) {
  std::vector<T> some;
  for (const std::string& each : names) {
    const auto found = std::ranges::find(all, each, name);
    if (found == all.end()) throw UsageError{fmt::format("{}: \"{}\" is none of the {}", flag, each, what)};
    if (std::ranges::count(names, each) > 1) throw UsageError{fmt::format("{}: \"{}\" stands twice", flag, each)};
    some.push_back(*found);
  }
  return names.empty() ? all : some;
}

Study factorial(const QuestionFlags& flags, const Scenario& scenario) {
  experiment::ArmBase base = flags.base;
  if (base.robots.empty()) base.robots = {"calibrated_1"};
  for (std::string& robot : base.robots) robot = find_robot(robot).string();
  const experiment::Arm like = arms_of("moving", base).front();
  if (flags.no_sweep) return experiment::factorial_study(scenario, like, flags.law, {}, {});
  return experiment::factorial_study(scenario, like, flags.law, flags.opponent_medians_m, flags.eye_biases_m);
}

Study frontier(const QuestionFlags& flags, const Scenario& scenario) {
  std::vector<experiment::Arm> others = arms_of(flags.beside, flags.base);
  others.push_back(arms_of("oracle", flags.base).front());
  return experiment::frontier_study(scenario, arms_of(flags.policy, flags.base).front(), flags.thresholds, others);
}

Study robustness(const QuestionFlags& flags, const Scenario& scenario) {
  const std::vector<experiment::Arm> all = arms_of(flags.arms, flags.base);
  if (std::ranges::find(all, flags.rival, &experiment::Arm::name) == all.end())
    throw UsageError{fmt::format("--rival: \"{}\" is none of the arms", flags.rival)};
  if (all.size() < 2) throw UsageError{"--arms: two or more, all are compared with one"};
  return experiment::robustness_study(
      all, flags.rival,
      chosen(config::load_worlds(flags.table, scenario), flags.named, &config::NamedWorld::name, "--only", "worlds"));
}

Study sensitivity(const QuestionFlags& flags, const Scenario& scenario) {
  const std::vector<experiment::Arm> all = arms_of(flags.arms, flags.base);
  auto varied = chosen(experiment::load_inputs(flags.table), flags.named, &experiment::UncertainInput::key, "--input",
                       "uncertain inputs");
  std::erase_if(varied, [&](const experiment::UncertainInput& input) {
    if (experiment::in_force(scenario, input)) return false;
    if (flags.named.empty()) return true;
    throw UsageError{fmt::format("--input: \"{}\" is off in this scenario: it has no {}", input.key,
                                 input.key.substr(0, input.key.find('.')))};
  });
  if (all.size() < 2) throw UsageError{"--arms: two or more, each is compared with the one before it"};
  if (flags.goals && !scenario.keeper.enabled)
    throw UsageError{"--goals: this scenario has no keeper; see config/scenarios/keeper.toml"};
  return experiment::sensitivity_study(scenario, all, varied,
                                       flags.goals ? experiment::Measure::kGoals : experiment::Measure::kPerOpportunity,
                                       [](const std::string& why) { warn("left out: " + why); });
}

constexpr Question kQuestions[]{
    {"arms", "Arms on the same matches, each compared with the first",
     "As `trivela simulate`, but it keeps the counts of each match alone: no decisions, distances or crossings.",
     [](CLI::App& verb, QuestionFlags& flags) {
       add_default(verb, "--arms", flags.arms, "Policies, e.g. stopped,moving,predictive, or a file of arms (.toml)");
     },
     [](const QuestionFlags& flags, const Scenario& scenario) {
       return experiment::arms_study(scenario, arms_of(flags.arms, flags.base));
     }},
    {"factorial", "What calibration buys and what motion buys",
     "The old table is drawn again for each match from the scenario's [hand_table]. Without --robot: calibrated_1.",
     [](CLI::App& verb, QuestionFlags& flags) {
       add_default(verb, "--opponent-median", flags.opponent_medians_m, "Opponents' median distances of the sweep [m]",
                   CLI::Range(0.3, 50.0))
           ->delimiter(',');
       add_default(verb, "--eye-bias", flags.eye_biases_m,
                   "Second sweep: what seems right to the old table's maker is so much too high [m]",
                   CLI::Range(-0.5, 1.0))
           ->delimiter(',');
       add_default(verb, "--law", flags.law, "Law of both sides of the sweeps",
                   CLI::IsMember(experiment::kFactorialLaws));
       verb.add_flag("--no-sweep", flags.no_sweep, "The factorial alone");
     },
     factorial},
    {"frontier", "Efficiency against volume, swept over a policy's firing threshold",
     "A policy is compared with the frontier at its own number of kicks; between thresholds the frontier is linear.",
     [](CLI::App& verb, QuestionFlags& flags) {
       const auto swept = kicking::policies_where(
           [](const auto& facts) { return facts.kind == kicking::PolicyKind::kPredictive && !facts.needs_truth(); });
       add_default(verb, "--policy", flags.policy, "Which is swept", CLI::IsMember(swept));
       add_default(verb, "--threshold", flags.thresholds, "Least probabilities of a ball on target that it fires at",
                   CLI::Range(0.0, 1.0))
           ->delimiter(',');
       add_default(verb, "--beside", flags.beside,
                   "Arms beside the frontier and oracle: policies, or a file of arms (.toml)");
     },
     frontier},
    {"robustness", "How policies stand worlds that robots do not expect",
     "Every arm plays every world. Robots are calibrated in the study's scenario (--calibrations) and not again.",
     [](CLI::App& verb, QuestionFlags& flags) {
       flags.plan.matches = 200;  // of each arm and world
       flags.arms = config::shipped("arms/robustness.toml").string();
       flags.table = config::shipped("studies/robustness.toml").string();
       add_default(verb, "--arms", flags.arms, "Policies, or a file of arms (.toml)");
       add_default(verb, "--rival", flags.rival, "The arm that the others are compared with");
       add_default(verb, "--worlds", flags.table, "File of the worlds")->type_name("TOML");
       verb.add_option("--only", flags.named, "Only these worlds, e.g. keeper,\"twice the drag\"")->delimiter(',');
     },
     robustness},
    {"sensitivity", "How far the comparison of policies rests on assumed inputs",
     "One input at a time; robots are not calibrated again. The hand table matters to arms with it (@old) alone.",
     [](CLI::App& verb, QuestionFlags& flags) {
       flags.plan.matches = 200;  // of each value
       flags.table = config::shipped("studies/sensitivity.csv").string();
       add_default(verb, "--arms", flags.arms, "Policies, each compared with the one before it");
       add_default(verb, "--inputs", flags.table, "Table of the inputs with their low and high values, and why")
           ->type_name("CSV");
       verb.add_option("--input", flags.named, "Only these, e.g. kicker.delay_s,vision.latency_s")->delimiter(',');
       verb.add_flag("--goals", flags.goals, "Goals past the keeper instead of shots on target");
     },
     sensitivity}};

/// Plays the study and gives its report: printed as text or JSON, and the files that were asked for last, so that a
/// full disk takes no more than the file. A shard's part has no report.
int ask(const Question& question, QuestionFlags flags) {
  flags.require_writable();
  const Scenario scenario = flags.world.load();
  const Study study = question.study(flags, scenario);
  std::vector<Scenario> played;
  for (const experiment::StudyWorld& world : study.worlds) played.push_back(world.scenario);
  flags.world.require_effect(played);
  draw_calibrations(scenario, flags.base, flags.calibrations, flags.plan);
  const std::vector<experiment::Arm>& arms = study.worlds.front().arms;
  if (flags.calibrations == 0)
    for (const std::string& remark : experiment::shared_robots(scenario, arms)) warn(remark);
  for (const experiment::Arm& arm : arms) check_playable(scenario, arm, flags.plan.possessions);
  StudyRun run{flags, study.name, arguments_of(study)};
  try {
    auto rows = run.play(study.worlds, flags.plan).rows;
    run.finish();
    if (const auto& shard = flags.plan.shard) {
      const auto range = flags.plan.range();
      fmt::print(
          "shard {}: matches {} to {} of {} are in {}. For the report give this command --with and the files of all "
          "shards, in place of --shard and --results\n",
          shard->text(), range.begin, range.end - 1, flags.plan.matches, flags.results);
      return kDone;
    }
    const experiment::StudyReport report = report_of(study, std::move(rows), flags.played(scenario));
    flags.json ? fmt::print("{}", evaluator::json_text(report.json)) : say(report.text);
    std::fflush(stdout);
    if (!flags.csv.empty()) write_file(flags.csv, report.csv);
    if (!flags.svg.empty()) write_file(flags.svg, report.svg);
  } catch (const StudyRun::Interrupted&) {
    return run.keep();
  }
  return kDone;
}

}  // namespace

void add_questions(CLI::App& study, int& exit_code) {
  for (const Question& question : kQuestions) {
    CLI::App& verb = *study.add_subcommand(question.name, question.asks);
    const auto flags = std::make_shared<QuestionFlags>();
    verb.callback([flags, &question, &exit_code] { exit_code = ask(question, *flags); });
    question.add_options(verb, *flags);
    add_play_options(verb, *flags);
    add_default(verb, "--blocked", flags->blocked,
                "Blocked kicks: outside, as in Table 2, or apart: efficiency is of the others",
                CLI::IsMember({"outside", "apart"}));
    verb.add_option("--csv", flags->csv, "Everything that was counted as CSV")->type_name("FILE");
    verb.add_option("--svg", flags->svg, "A chart")->type_name("FILE");
    verb.add_flag("--json", flags->json, "JSON instead of text");
    verb.footer(question.more);
  }
}

}  // namespace trivela::cli
