// What a team gets from geometry, from statistics and from learning, on the same matches: policies, and `learned` with
// corrections that were fitted to logs of few kicks. Simulated; outcomes are what the robots' observer saw.
//     build/release/tests/learning_from_logs --model config/learned.toml [--svg FILE] [--csv FILE]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "cli/options/play_options.hpp"
#include "config/learned_model.hpp"
#include "config/text/installation.hpp"
#include "evaluator/learning/learned_fit.hpp"
#include "evaluator/render/svg_chart.hpp"
#include "evaluator/render/text_table.hpp"
#include "experiment/calibration/simulated_calibration.hpp"
#include "experiment/play/play_match.hpp"
#include "experiment/run/arms.hpp"
#include "experiment/run/in_threads.hpp"
#include "experiment/study/effects.hpp"

namespace {

using namespace trivela;
using experiment::ArmTally;
using kicking::PolicyName;

constexpr std::uint32_t kOfALog = 4;  ///< opportunities of a match of a log: logs of 30 kicks have some ten matches
constexpr std::uint32_t kLogMatches = 1'000'000;  ///< the logs' matches begin there: none of them is played again

struct Flags {
  cli::World world;
  std::string model = config::shipped("learned.toml").string(), correction, svg, csv;
  std::uint64_t seed = 1;
  std::uint32_t robots = 20, matches = 100, possessions = 10;
  std::vector<std::size_t> sizes{30, 100, 300};
  bool no_logs = false;
  unsigned jobs = 1;
};

struct Way {
  std::string name, kind;  ///< geometry, statistics, learning
  PolicyName policy;
  std::vector<std::optional<kicking::LearnedModel>> models;  ///< of each robot
  std::size_t better = 0;                                    ///< logs whose held-out part says that the model is better
  bool places = false;                                       ///< it goes by where opponents stand
};

experiment::Arm arm_of(const config::Robot& robot, PolicyName policy,
                       const std::optional<kicking::LearnedModel>& model = {}) {
  experiment::Arm arm;
  arm.policy = policy;
  arm.robots = {robot};
  arm.settings.policy.learned = model;
  return arm;
}

/// The first `size` kicks that the robot makes with `predictive`.
std::vector<evaluator::PredictedKick> log_of(const Flags& flags, const sim::Scenario& world, const config::Robot& robot,
                                             std::uint32_t number, std::size_t size) {
  std::vector<evaluator::PredictedKick> kicks;
  const experiment::Arm arm = arm_of(robot, PolicyName::kPredictive);
  for (std::uint32_t match = 0; kicks.size() < size; ++match) {
    const std::uint32_t id = kLogMatches * (number + 1) + match;
    for (const auto& possession : experiment::play_match(world, arm, flags.seed, id, kOfALog).possessions) {
      if (!possession.kick || !possession.kick->p_on_target || kicks.size() == size) continue;
      const experiment::PlayedKick& kick = *possession.kick;
      if (kick.observed == kicking::Outcome::kUnknown) continue;
      kicks.push_back({match,
                       {*kick.p_on_target, kick.distance_m, kick.vx_mps, kick.vy_mps, kick.omega_radps, kick.power,
                        kick.opponent_distance_m},
                       kick.observed == kicking::Outcome::kOnTarget});
    }
  }
  return kicks;
}

Way learned_from(const Flags& flags, const sim::Scenario& world, const std::vector<config::Robot>& robots,
                 std::size_t size) {
  Way way{fmt::format("{} kicks", size), "learning", PolicyName::kLearned, {}, 0};
  way.models.resize(robots.size());
  std::vector<int> better(robots.size());
  experiment::in_threads(robots.size(), flags.jobs, [&](std::size_t i) {
    evaluator::LearnOptions options;
    options.fewest_kicks = 1;
    try {
      const auto fit =
          evaluator::fit_learned_model(log_of(flags, world, robots[i], static_cast<std::uint32_t>(i), size), options);
      way.models[i] = fit.model;
      better[i] = fit.held_out.better() ? 1 : 0;
    } catch (const std::exception&) {
      way.models[i].emplace();  // kicks of one outcome alone: nothing is learned
    }
  });
  for (const int one : better) way.better += static_cast<std::size_t>(one);
  return way;
}

ArmTally play(const Flags& flags, const sim::Scenario& world, const std::vector<config::Robot>& robots,
              const Way& way) {
  ArmTally tally(flags.matches);
  experiment::in_threads(tally.size(), flags.jobs, [&](std::size_t m) {
    const std::size_t robot = m % robots.size();
    auto arm = arm_of(robots[robot], way.policy, way.models.empty() ? std::nullopt : way.models[robot]);
    arm.settings.policy.predictive.opponent_places = way.places;
    tally[m].calibration = static_cast<std::uint32_t>(robot);
    for (const auto& possession :
         experiment::play_match(world, arm, flags.seed, static_cast<std::uint32_t>(m), flags.possessions).possessions) {
      ++tally[m].opportunities;
      if (!possession.kick) continue;
      ++tally[m].kicks;
      tally[m].on_target += possession.kick->observed == kicking::Outcome::kOnTarget;
      tally[m].goals += possession.kick->truth == kicking::Outcome::kOnTarget && !possession.kick->truth_saved;
    }
  });
  return tally;
}

std::string chart_of(const std::vector<Way>& ways, const std::vector<experiment::Effect>& shares, bool goals) {
  evaluator::Chart chart{"Geometry, statistics, learning",
                         "",
                         goals ? "goals of 100 opportunities" : "on target of 100 opportunities",
                         {},
                         {},
                         true};
  const std::vector<std::string> kinds{"geometry", "statistics", "learning"};
  for (std::size_t k = 0; k < kinds.size(); ++k)
    chart.series.push_back({kinds[k], {}, evaluator::ChartMark::kDots, static_cast<int>(k), 0});
  for (std::size_t i = 0; i < ways.size(); ++i) {
    chart.x_categories.push_back(ways[i].name);
    const auto kind = static_cast<std::size_t>(std::ranges::find(kinds, ways[i].kind) - kinds.begin());
    chart.series[kind].points.push_back({static_cast<double>(i), 100.0 * shares[i].value});
  }
  return evaluator::to_svg(chart);
}

/// Geometry and statistics.
std::vector<Way> by_hand() {
  return {{"stopped", "geometry", PolicyName::kStopped, {}, 0},
          {"moving", "geometry", PolicyName::kMoving, {}, 0},
          {"predictive", "statistics", PolicyName::kPredictive, {}, 0},
          {"places", "statistics", PolicyName::kPredictive, {}, 0, true}};
}

void report(const Flags& flags, bool goals, const std::vector<Way>& ways, const std::vector<ArmTally>& played,
            std::size_t logs_from, std::size_t logs_to) {
  const auto measure = goals ? experiment::Measure::kGoals : experiment::Measure::kPerOpportunity;
  fmt::print(
      "SIMULATED: {} robots, each calibrated; {} matches of {} opportunities, seed {}; {} of 100 opportunities\n",
      flags.robots, flags.matches, flags.possessions, flags.seed, goals ? "goals" : "on target");
  std::vector<std::vector<std::string>> rows{
      {"way", "kind", "of 100 (95 %)", "less predictive", "less places", "held out: better"}};
  std::vector<experiment::Effect> shares;
  std::string csv = "way,kind,value,low,high,difference,difference_low,difference_high,held_out_better\n";
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const std::vector<experiment::Term> terms{{&played[i], 1.0}, {&played[2], -1.0}};
    const experiment::Effect share = experiment::share_of(played[i], measure);
    const std::vector<experiment::Term> placed{{&played[i], 1.0}, {&played[3], -1.0}};
    const experiment::Effect less = experiment::contrast(terms, measure);
    shares.push_back(share);
    const bool from_log = i >= logs_from && i < logs_to;
    rows.push_back({ways[i].name, ways[i].kind, experiment::share_text(share),
                    i == 2 ? "" : experiment::points_text(less),
                    i == 3 ? "" : experiment::points_text(experiment::contrast(placed, measure)),
                    from_log ? fmt::format("{} of {}", ways[i].better, flags.robots) : ""});
    csv += fmt::format("{},{},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{}\n", ways[i].name, ways[i].kind, share.value,
                       share.ci.lo, share.ci.hi, less.value, less.ci.lo, less.ci.hi, ways[i].better);
  }
  fmt::print("{}", evaluator::text_table(rows));
  if (!flags.csv.empty()) std::ofstream{flags.csv} << csv;
  if (!flags.svg.empty()) std::ofstream{flags.svg} << chart_of(ways, shares, goals);
}

void run(const Flags& flags) {
  const sim::Scenario world = flags.world.load();
  std::vector<config::Robot> robots(flags.robots);
  experiment::in_threads(robots.size(), flags.jobs, [&](std::size_t i) {
    robots[i] = experiment::calibrated_robot(
        world, static_cast<std::int64_t>(experiment::calibration_seed(flags.seed, static_cast<std::uint32_t>(i), 1)));
  });
  std::vector<Way> ways = by_hand();
  const std::size_t logs_from = ways.size(), logs_to = logs_from + (flags.no_logs ? 0 : flags.sizes.size());
  for (std::size_t i = 0; i + logs_from < logs_to; ++i)
    ways.push_back(learned_from(flags, world, robots, flags.sizes[i]));
  if (!flags.correction.empty()) {
    const config::LearnedModelFile file = config::load_learned_model(flags.correction);
    ways.push_back({fmt::format("{:.0f}k kicks", 1e-3 * file.training.kicks),
                    "learning",
                    PolicyName::kLearned,
                    {robots.size(), file.model},
                    0});
  }
  const kicking::LearnedModel searched = config::load_learned_model(flags.model).model;
  ways.push_back({"search", "learning", PolicyName::kLearned, {robots.size(), searched}, 0});

  std::vector<ArmTally> played;
  played.reserve(ways.size());
  for (const Way& way : ways) played.push_back(play(flags, world, robots, way));
  report(flags, world.keeper.enabled, ways, played, logs_from, logs_to);
}

int play_all(int argc, char** argv) {
  Flags flags;
  CLI::App app{"Geometry, statistics and learning on the same matches"};
  cli::add_world_options(app, flags.world);
  app.add_option("--model", flags.model, "The learned decision");
  app.add_option("--correction", flags.correction, "One that `trivela study learn` has made of more kicks");
  app.add_option("--sizes", flags.sizes, "Kicks of the logs");
  app.add_flag("--no-logs", flags.no_logs, "Nothing is learned from logs");
  app.add_option("--robots", flags.robots, "each with a calibration and a log")->check(CLI::Range(2, 1000));
  app.add_option("--matches", flags.matches, "that all play");
  app.add_option("--possessions", flags.possessions, "Opportunities of a match");
  app.add_option("--seed", flags.seed, "of everything");
  app.add_option("--jobs", flags.jobs, "Threads");
  app.add_option("--svg", flags.svg, "A chart");
  app.add_option("--csv", flags.csv, "The numbers");
  CLI11_PARSE(app, argc, argv);
  run(flags);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return play_all(argc, argv);
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
    return 1;
  }
}
