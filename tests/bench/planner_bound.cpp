// How much a robot could win by driving otherwise. A planner knows the world and has all the time that it wants. It
// looks for the best way of each opportunity under the robot's limits, and drives it in the same world. Simulated.
//     build/release/tests/planner_bound --scenario config/scenarios/flat_keeper.toml [--matches 100] [--samples 64]
// The opportunities are those of `trivela simulate` with the same seed, matches and possessions.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <random>

#include "cli/options/play_options.hpp"
#include "config/scenario/scenario.hpp"
#include "config/settings.hpp"
#include "experiment/play/oracle.hpp"
#include "experiment/play/play_match.hpp"
#include "experiment/run/in_threads.hpp"
#include "kicking/geometry/time.hpp"
#include "sim/match.hpp"
#include "tests/bench/drive_planner.hpp"

namespace {

using namespace trivela;
using namespace trivela::bench;

struct Tally {
  int opportunities = 0, kicks = 0, on_target = 0, goals = 0, blocked = 0, disputed = 0, hopeless = 0;
  double promised = 0.0, known = 0.0;  ///< sums of the plans' values, and of the best of the policy's own ways
};

struct Flags {
  cli::World world;
  std::uint64_t seed = 1;
  std::uint32_t matches = 100, possessions = 10;
  int samples = 64, rounds = 25;
  bool on_target = false;
  double sideways_mps = HUGE_VAL;
};

/// A match in which each possession is planned when it begins, and then driven.
class PlannedMatch {
 public:
  PlannedMatch(const sim::Scenario& scenario, const Flags& flags, std::uint32_t match_id)
      : scenario_(scenario),
        flags_(flags),
        random_{experiment::match_seed(flags.seed, match_id)},
        settings_(config::on_field_of(scenario, config::Settings{})),
        match_{scenario, experiment::match_seed(flags.seed, match_id), 1, 1e6, flags.possessions} {
    settings_.policy.objective = flags.on_target ? kicking::Objective::kOnTarget : kicking::Objective::kGoal;
    config_ = experiment::oracle_config(settings_.policy, scenario);
  }

  Tally play() {
    while (!match_.done()) {
      const sim::Sensors sensors = match_.sense();
      const sim::TrueState state = match_.true_state();
      const bool plays = sensors.referee.playing && state.ball_held;
      if (!plays) plan_.reset();
      if (plays && !plan_) plan(sensors, state);
      count(match_.step(plan_ ? commands(sensors.t_ns - from_ns_) : sim::Commands{}));
    }
    return tally_;
  }

 private:
  void plan(const sim::Sensors& sensors, const sim::TrueState& state) {
    const kicking::RobotModel robot =
        experiment::oracle_robot(scenario_, match_.true_kicker(sensors.carrier), scenario_.kicker.flat.enabled ? 2 : 1);
    const double dispute_s = kicking::seconds(state.dispute_t_ns - sensors.t_ns);
    Worth worth{scenario_, config_, robot, settings_.goal, state, std::min(dispute_s, kLongest_s)};
    auto known = plans_of_the_policy(state, config_, settings_.goal, worth.cycles());
    for (Plan& one : known) worth.judge(one);
    std::ranges::sort(known, is_better);
    plan_ = Search{worth, scenario_, flags_.sideways_mps, flags_.samples, flags_.rounds, random_}.best(known);
    tally_.known += known.front().value;
    tally_.promised += plan_->value;
    tally_.hopeless += plan_->value < 0.02 ? 1 : 0;
    from_ns_ = sensors.t_ns;
  }

  sim::Commands commands(std::int64_t now_ns) {
    sim::Commands commands;
    const auto cycle = static_cast<std::size_t>(std::llround(kicking::seconds(now_ns) / scenario_.cycle_s));
    if (cycle < plan_->commands.size()) commands.drive = plan_->commands[cycle];
    commands.lever_kind = plan_->kind;
    const std::int64_t fire_ns = kicking::nanoseconds(plan_->fire_after_s);
    if (plan_->value > 0.0 && fire_ns >= now_ns && fire_ns < now_ns + kicking::nanoseconds(scenario_.cycle_s))
      commands.fire = sim::Fire{from_ns_ + fire_ns, ++kick_id_, plan_->power};
    return commands;
  }

  void count(const sim::StepEvents& events) {
    for (const sim::KickTruth& kick : events.kicks) {
      ++tally_.kicks;
      tally_.on_target += kick.outcome == kicking::Outcome::kOnTarget ? 1 : 0;
      tally_.goals += kick.outcome == kicking::Outcome::kOnTarget && !kick.saved ? 1 : 0;
      tally_.blocked += kick.outcome == kicking::Outcome::kBlocked ? 1 : 0;
    }
    for (const sim::PossessionTruth& possession : events.possessions) {
      ++tally_.opportunities;
      tally_.disputed += possession.ending == sim::PossessionEnd::kDisputed ? 1 : 0;
    }
  }

  const sim::Scenario& scenario_;
  const Flags& flags_;
  std::mt19937_64 random_;
  config::Settings settings_;
  kicking::PolicyConfig config_;
  sim::Match match_;
  std::optional<Plan> plan_;
  std::int64_t from_ns_ = 0, kick_id_ = 0;
  Tally tally_;
};

void say(const Tally& all, std::uint64_t seed) {
  const auto share = [&](double n) { return 100.0 * n / all.opportunities; };
  fmt::print("SIMULATED: a planner that knows the world, of {} opportunities, seed {}\n", all.opportunities, seed);
  fmt::print("of 100 opportunities: goals {:.1f}, on target {:.1f}, kicks {:.1f}, blocked {:.1f}, disputed {:.1f}\n",
             share(all.goals), share(all.on_target), share(all.kicks), share(all.blocked), share(all.disputed));
  fmt::print("its plans promise {:.1f}, the best of the policy's own ways {:.1f}; hopeless (below 2 %) {:.1f}\n",
             share(all.promised), share(all.known), share(all.hopeless));
}

void play_all(const Flags& flags) {
  const sim::Scenario scenario = flags.world.load();
  std::vector<Tally> tallies(flags.matches);
  experiment::in_threads(flags.matches, 2, [&](std::size_t i) {
    tallies[i] = PlannedMatch{scenario, flags, static_cast<std::uint32_t>(i)}.play();
  });
  Tally all;
  for (const Tally& one : tallies) {
    all.opportunities += one.opportunities, all.kicks += one.kicks, all.on_target += one.on_target;
    all.goals += one.goals, all.blocked += one.blocked, all.disputed += one.disputed, all.hopeless += one.hopeless;
    all.promised += one.promised, all.known += one.known;
  }
  say(all, flags.seed);
}

int run(int argc, char** argv) {
  Flags flags;
  CLI::App app{"What a planner with perfect knowledge and all the time that it wants wins of the same opportunities"};
  cli::add_world_options(app, flags.world);
  app.add_option("--seed", flags.seed, "of all matches, as in trivela simulate")->capture_default_str();
  app.add_option("--matches", flags.matches, "Matches")->check(CLI::Range(1, 100000))->capture_default_str();
  app.add_option("--possessions", flags.possessions, "Opportunities of each")->capture_default_str();
  app.add_option("--samples", flags.samples, "Plans of a round")->check(CLI::Range(8, 100000))->capture_default_str();
  app.add_option("--rounds", flags.rounds, "Rounds from each of four starts")->capture_default_str();
  app.add_flag("--on-target", flags.on_target, "Plans for balls on target, as if no keeper stood there");
  app.add_option("--sideways", flags.sideways_mps, "Greatest sideways speed [m/s], as policy.max_sideways_mps")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  play_all(flags);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
    return 1;
  }
}
