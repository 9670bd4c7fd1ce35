// The studies that are arms in worlds: flags, and what they play of them. They end in run_study().
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/calibrate/robot_file.hpp"
#include "cli/study/study.hpp"
#include "config/scenario/scenario.hpp"
#include "experiment/study/studies.hpp"

namespace trivela::cli {
namespace {

using experiment::arms_of;

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

/// Each value once, rising.
std::vector<double> sorted(std::vector<double> values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

struct Arms : StudyFlags {
  static constexpr const char* kName = "arms";
  static constexpr const char* kAsks = "Arms on the same matches, each compared with the first";
  static constexpr const char* kMore =
      "As `trivela simulate`, but it keeps the counts of each match alone: no decisions, distances or crossings.";
  std::string arms = "stopped@old,stopped,moving,predictive";

  void add_options(CLI::App& verb) {
    add_default(verb, "--arms", arms, "Policies, e.g. stopped,moving,predictive, or a file of arms (.toml)");
  }
  experiment::Study study(const sim::Scenario& scenario) const {
    return experiment::arms_study(scenario, arms_of(arms, base));
  }
};

struct Factorial : StudyFlags {
  static constexpr const char* kName = "factorial";
  static constexpr const char* kAsks = "What calibration buys and what motion buys";
  static constexpr const char* kMore =
      "The old table is drawn again for each match from the scenario's [hand_table]. Without --robot: calibrated_1.";
  std::vector<double> opponent_medians_m{0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0};
  std::vector<double> eye_biases_m{0.0, 0.1, 0.15};
  std::string law = "released";
  bool no_sweep = false;

  void add_options(CLI::App& verb) {
    add_default(verb, "--opponent-median", opponent_medians_m, "Opponents' median distances of the sweep [m]",
                CLI::Range(0.3, 50.0))
        ->delimiter(',');
    add_default(verb, "--eye-bias", eye_biases_m,
                "Second sweep: what seems right to the old table's maker is so much too high [m]",
                CLI::Range(-0.5, 1.0))
        ->delimiter(',');
    add_default(verb, "--law", law, "Law of both sides of the sweeps", CLI::IsMember(experiment::factorial_laws()));
    verb.add_flag("--no-sweep", no_sweep, "The factorial alone");
  }
  experiment::Study study(const sim::Scenario& scenario) const {
    experiment::ArmBase of_all = base;
    if (of_all.robots.empty()) of_all.robots = {"calibrated_1"};
    for (std::string& robot : of_all.robots) robot = find_robot(robot).string();
    const experiment::Arm like = arms_of("moving", of_all).front();
    if (no_sweep) return experiment::factorial_study(scenario, like, law, {}, {});
    return experiment::factorial_study(scenario, like, law, sorted(opponent_medians_m), sorted(eye_biases_m));
  }
};

struct Frontier : StudyFlags {
  static constexpr const char* kName = "frontier";
  static constexpr const char* kAsks = "Efficiency against volume, swept over a policy's firing threshold";
  static constexpr const char* kMore =
      "A policy is compared with the frontier at its own number of kicks; between thresholds the frontier is linear.";
  std::string policy = "predictive";
  std::vector<double> thresholds{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95};
  std::string beside = config::shipped("arms/baselines.toml").string();

  void add_options(CLI::App& verb) {
    const auto swept = kicking::policies_where(
        [](const auto& facts) { return facts.kind == kicking::PolicyKind::kPredictive && !facts.needs_truth(); });
    add_default(verb, "--policy", policy, "Which is swept", CLI::IsMember(swept));
    add_default(verb, "--threshold", thresholds, "Least probabilities of a ball on target that it fires at",
                CLI::Range(0.0, 1.0))
        ->delimiter(',');
    add_default(verb, "--beside", beside, "Arms beside the frontier and oracle: policies, or a file of arms (.toml)");
  }
  experiment::Study study(const sim::Scenario& scenario) const {
    std::vector<experiment::Arm> others = arms_of(beside, base);
    others.push_back(arms_of("oracle", base).front());
    return experiment::frontier_study(scenario, arms_of(policy, base).front(), sorted(thresholds), others);
  }
};

struct Robustness : StudyFlags {
  static constexpr const char* kName = "robustness";
  static constexpr const char* kAsks = "How policies stand worlds that robots do not expect";
  static constexpr const char* kMore =
      "Every arm plays every world. Robots are calibrated in the study's scenario (--calibrations) and not again.";
  std::string arms = config::shipped("arms/robustness.toml").string();
  std::string rival = "moving";
  std::string worlds = config::shipped("studies/robustness.toml").string();
  std::vector<std::string> only;

  void add_options(CLI::App& verb) {
    plan.matches = 200;  // of each arm and world
    add_default(verb, "--arms", arms, "Policies, or a file of arms (.toml)");
    add_default(verb, "--rival", rival, "The arm that the others are compared with");
    add_default(verb, "--worlds", worlds, "File of the worlds")->type_name("TOML");
    verb.add_option("--only", only, "Only these worlds, e.g. keeper,\"twice the drag\"")->delimiter(',');
  }
  experiment::Study study(const sim::Scenario& scenario) const {
    const std::vector<experiment::Arm> all = arms_of(arms, base);
    if (std::ranges::find(all, rival, &experiment::Arm::name) == all.end())
      throw UsageError{fmt::format("--rival: \"{}\" is none of the arms", rival)};
    if (all.size() < 2) throw UsageError{"--arms: two or more, all are compared with one"};
    return experiment::robustness_study(
        all, rival, chosen(config::load_worlds(worlds, scenario), only, &config::NamedWorld::name, "--only", "worlds"));
  }
};

struct Sensitivity : StudyFlags {
  static constexpr const char* kName = "sensitivity";
  static constexpr const char* kAsks = "How far the comparison of policies rests on assumed inputs";
  static constexpr const char* kMore =
      "One input at a time; robots are not calibrated again. The hand table matters to arms with it (@old) alone.";
  std::string arms = "stopped@old,stopped,moving,predictive";
  std::string table = config::shipped("studies/sensitivity.csv").string();
  std::vector<std::string> inputs;
  bool goals = false;

  void add_options(CLI::App& verb) {
    plan.matches = 200;  // of each value
    add_default(verb, "--arms", arms, "Policies, each compared with the one before it");
    add_default(verb, "--inputs", table, "Table of the inputs with their low and high values, and why")
        ->type_name("CSV");
    verb.add_option("--input", inputs, "Only these, e.g. kicker.delay_s,vision.latency_s")->delimiter(',');
    verb.add_flag("--goals", goals, "Goals past the keeper instead of shots on target");
  }
  experiment::Study study(const sim::Scenario& scenario) const {
    const std::vector<experiment::Arm> all = arms_of(arms, base);
    auto varied =
        chosen(experiment::load_inputs(table), inputs, &experiment::UncertainInput::key, "--input", "uncertain inputs");
    std::erase_if(varied, [&](const experiment::UncertainInput& input) {
      if (experiment::in_force(scenario, input)) return false;
      if (inputs.empty()) return true;
      throw UsageError{fmt::format("--input: \"{}\" is off in this scenario: it has no {}", input.key,
                                   input.key.substr(0, input.key.find('.')))};
    });
    if (all.size() < 2) throw UsageError{"--arms: two or more, each is compared with the one before it"};
    if (goals && !scenario.keeper.enabled)
      throw UsageError{"--goals: this scenario has no keeper; see config/scenarios/keeper.toml"};
    return experiment::sensitivity_study(scenario, all, varied,
                                         goals ? experiment::Measure::kGoals : experiment::Measure::kPerOpportunity,
                                         [](const std::string& why) { warn("left out: " + why); });
  }
};

template <class Question>
int ask(const Question& question) {
  return run_study(question, [&](const sim::Scenario& scenario) { return question.study(scenario); });
}

template <class Question>
void add_question(CLI::App& study, int& exit_code) {
  const auto [verb, flags] = add_verb(study, exit_code, Question::kName, Question::kAsks, ask<Question>);
  flags->add_options(*verb);
  add_play_options(*verb, *flags);
  add_default(*verb, "--blocked", flags->blocked,
              "Blocked kicks: outside, as in Table 2, or apart: efficiency is of the others",
              CLI::IsMember({"outside", "apart"}));
  verb->add_option("--csv", flags->csv, "Everything that was counted as CSV")->type_name("FILE");
  verb->add_option("--svg", flags->svg, "A chart")->type_name("FILE");
  verb->add_flag("--json", flags->json, "JSON instead of text");
  verb->footer(Question::kMore);
}

}  // namespace

void add_questions(CLI::App& study, int& exit_code) {
  add_question<Arms>(study, exit_code);
  add_question<Factorial>(study, exit_code);
  add_question<Frontier>(study, exit_code);
  add_question<Robustness>(study, exit_code);
  add_question<Sensitivity>(study, exit_code);
}

}  // namespace trivela::cli
