#include "experiment/run/experiment.hpp"

#include <fmt/format.h>

#include <chrono>
#include <map>

#include "config/scenario/scenario.hpp"
#include "config/text/error.hpp"
#include "config/text/installation.hpp"
#include "evaluator/render/text_table.hpp"
#include "experiment/run/match_play.hpp"
#include "experiment/study/effects.hpp"
#include "log/read/reader.hpp"
#include "log/schema/digest.hpp"
#include "log/write/experiment_log.hpp"
#include "robot/decision/assignment.hpp"
#include "robot/recording/session_text.hpp"

namespace trivela::experiment {
namespace {

using log::ExperimentLog;
using log::Session;

constexpr std::uint32_t kTriedMatches = 100;  // whose robots are made before the log is

/// The policy of the half where all robots have the same one, else each robot's; none where it is drawn.
std::vector<log::HalfPolicy> policies_of(const ExperimentPlan& plan, const Arm& arm) {
  if (const auto policy = only_policy(plan.scenario, arm)) return {{1, kicking::name(*policy)}};
  std::vector<log::HalfPolicy> policies;
  const config::KickDecision settings = settings_of(arm, plan.options).kick_decision;
  for (std::uint8_t robot_id = 1; robot_id <= team_size(plan.scenario); ++robot_id) {
    const robot::PolicyAssignment assignment{settings, robot_id};
    if (!assignment.random()) policies.push_back({1, kicking::name(assignment.in_charge(1, 1).policy), robot_id});
  }
  return policies;
}

Session session_of(const ExperimentPlan& plan, const Arm& arm) {
  Session session;
  if (arm.robots.size() == 1 && team_size(plan.scenario) == 1) session.robot_id = 1;
  session.simulated = session.simulated_clock = true;
  session.config_toml =
      robot::session_config(settings_of(arm, plan.options), arm.robots, config::to_toml_text(plan.scenario));
  session.software_version = config::software_version();
  session.scenario = plan.scenario_name;
  session.idl = robot::idl_text();
  session.policies = policies_of(plan, arm);
  session.arm = arm.name;
  session.kicker_table = arm.table;
  return session;
}

/// Sessions of an experiment's arms; what all matches of a calibration share is made once.
class Sessions {
 public:
  Sessions(const ExperimentPlan& plan, const std::string& arguments)
      : arguments_sha256_(log::sha256(arguments)), sessions_(std::max<std::size_t>(plan.calibrations.size(), 1)) {
    for (std::uint32_t k = 0; k < sessions_.size(); ++k) {
      for (const Arm& arm : plan.arms) {
        sessions_[k].push_back(session_of(plan, plan.in_match(k, arm)));
        if (!plan.calibrations.empty()) sessions_[k].back().calibration_id = k;
      }
    }
  }

  const Session& of(std::uint32_t match_id, std::size_t arm, std::uint64_t match_seed) {
    Session& session = sessions_[match_id % sessions_.size()][arm];
    session.uuid = log::experiment_uuid(arguments_sha256_, match_id, static_cast<std::uint32_t>(arm));
    session.match_id = match_id;
    session.seed = static_cast<std::int64_t>(match_seed);
    return session;
  }

 private:
  std::string arguments_sha256_;
  std::vector<std::vector<Session>> sessions_;  // by calibration and arm
};

/// What the arms did in each match.
std::map<std::string, ArmTally> tallies_of(const ExperimentPlan& plan, const std::string& out) {
  std::map<std::string, ArmTally> arms;
  const log::MatchRange range = plan.range();
  for (const Arm& arm : plan.arms) {
    ArmTally& tally = arms[arm.name];
    tally.reserve(range.size());
    for (std::uint32_t m = range.begin; m < range.end; ++m) tally.push_back({.calibration = plan.calibration_of(m)});
  }
  const log::Reader reader{out, log::Check::kQuick};  // it was just written
  const auto count = [&](const std::string& rows, std::int64_t MatchTally::*field) {
    reader.query("SELECT arm, match_id, count(*) FROM sessions JOIN " + rows + " GROUP BY arm, match_id",
                 [&](const std::string& arm, std::size_t match, std::int64_t n) {
                   arms.at(arm).at(match - range.begin).*field = n;
                 });
  };
  count("possession_truths USING (session_id)", &MatchTally::opportunities);
  count("kick_receipts USING (session_id) WHERE accepted = 1", &MatchTally::kicks);
  count("kick_outcomes USING (session_id) WHERE on_target = 1", &MatchTally::on_target);
  count("kick_truths USING (session_id) WHERE outcome = 'on_target' AND saved = 0", &MatchTally::goals);
  count("kick_truths USING (session_id) WHERE outcome = 'on_target'", &MatchTally::true_on_target);
  return arms;
}

}  // namespace

std::string to_text(const ExperimentPlan& plan, const ExperimentRun& run, const std::string& out) {
  const auto arms = tallies_of(plan, out);
  std::size_t width = 3;
  for (const Arm& arm : plan.arms) width = std::max(width, arm.name.size());
  const bool keeper = plan.scenario.keeper.enabled;
  std::string text = evaluator::kSimulated;
  text += fmt::format("{:<{}}  {:>13}  {:>8}  {:>9}  {:>21}  {:>16}{}  {:>26}\n", "arm", width, "opportunities",
                      "kicks", "on target", "on target/opportunity", "95 %", keeper ? "  goals/opportunity" : "",
                      "opportunities/s and core");
  for (std::size_t i = 0; i < plan.arms.size(); ++i) {
    const ArmTally& tally = arms.at(plan.arms[i].name);
    const MatchTally sum = total_of(tally);
    const Effect share = share_of(tally, Measure::kPerOpportunity);
    const double played = static_cast<double>(run.matches) * plan.possessions;
    const double goals = sum.opportunities > 0 ? share_of(tally, Measure::kGoals).value : 0.0;
    text += fmt::format("{:<{}}  {:>13}  {:>8}  {:>9}  {:>21.4f}  {:>16}{}  {:>26}\n", plan.arms[i].name, width,
                        sum.opportunities, sum.kicks, sum.on_target, sum.opportunities > 0 ? share.value : 0.0,
                        has_interval(share) ? fmt::format("{:.4f} to {:.4f}", share.ci.lo, share.ci.hi) : "-",
                        keeper ? fmt::format("  {:>17.4f}", goals) : "",
                        run.processor_s[i] > 0.0 ? fmt::format("{:.0f}", played / run.processor_s[i]) : "-");
  }
  if (plan.calibrations.empty()) {
    text += fmt::format("intervals by match: for these robot files, not for other calibrations (--calibrations)\n");
  } else {
    text += fmt::format("intervals by match and calibration: {} calibrations, match m has calibration m mod {}\n",
                        plan.calibrations.size(), plan.calibrations.size());
  }
  if (keeper) text += fmt::format("goals: by the simulator's truth, on target and past its keeper\n");
  for (const Arm& arm : plan.arms) text += label_warning(arm.name, arms.at(arm.name));
  log::Reader{out, log::Check::kQuick}.query(
      "SELECT arm, count(*) FROM sessions JOIN kick_receipts USING (session_id) WHERE refusal = 'out_of_range' GROUP "
      "BY arm",
      [&](const std::string& arm, std::int64_t orders) {
        text += fmt::format("{}: {} orders were refused, since their power lies outside the robot's set-points\n", arm,
                            orders);
      });
  const double opportunities =
      static_cast<double>(run.matches) * plan.possessions * static_cast<double>(plan.arms.size());
  return text + fmt::format("{:.0f} opportunities in {:.2f} s with {} job{}: {:.0f} a second\n", opportunities,
                            run.wall_s, plan.jobs, plan.jobs == 1 ? "" : "s",
                            run.wall_s > 0.0 ? opportunities / run.wall_s : 0.0);
}

std::string ExperimentPlan::arguments() const {
  std::string text = fmt::format("program = {}\nseed = {}\npossessions = {}\nshadows = {}\nevery_cycle = {}\n",
                                 config::software_version(), seed, possessions, options.shadows, options.every_cycle);
  text += "\n### scenario " + scenario_name + "\n" + config::to_toml_text(scenario);
  for (const Arm& arm : arms) text += "\n### arm\n" + describe(arm);
  return text + describe(calibrations);
}

void check_playable(const ExperimentPlan& plan) {
  if (plan.arms.size() > log::kMostArms)
    throw config::BadArgument{
        fmt::format("{} arms, {} at most fit into an experiment", plan.arms.size(), log::kMostArms)};
  for (const Arm& each : plan.arms) {
    check_playable(plan.scenario, each, plan.possessions);
    for (std::uint32_t match_id = 0; match_id < std::min(plan.matches, kTriedMatches); ++match_id) {
      const Arm arm = plan.in_match(match_id, each);
      for (std::uint8_t robot_id = 1; robot_id <= team_size(plan.scenario); ++robot_id) {
        try {
          robot_of(plan.scenario, arm, plan.seed, match_id, robot_id);
        } catch (const std::exception& error) {
          throw std::runtime_error{fmt::format("arm {}: {}", arm.name, error.what())};
        }
      }
    }
  }
}

ExperimentRun run_experiment(const ExperimentPlan& plan, const std::string& out, const ExperimentWatch& watch) {
  const std::string arguments = plan.arguments();
  const log::MatchRange range = plan.range();
  ExperimentLog log{
      out, {plan.shard ? log::stamped_arguments({arguments, *plan.shard, plan.matches}) : arguments, range.size()}};
  MatchTables tables{log};
  Sessions sessions{plan, arguments};
  const auto first = range.begin + static_cast<std::uint32_t>(log.matches_done());
  watch.found(log.matches_done());
  ExperimentRun run{.processor_s = std::vector<double>(plan.arms.size())};
  const auto started = std::chrono::steady_clock::now();
  const auto write = [&](std::uint32_t match_id, const std::vector<ArmMatch>& arms) {
    log.begin();
    for (std::size_t i = 0; i < arms.size(); ++i) {
      const PlayedMatch& match = arms[i].played;
      const std::int64_t session_id = log.add_session(sessions.of(match_id, i, match.match_seed), match.end_t_ns);
      tables.write(arms[i].record, session_id);
      run.processor_s[i] += arms[i].processor_s;
    }
    log.end_match();
    if (watch.played) watch.played(match_id, arms);
  };
  play_matches(plan, first, true, watch, write);
  log.commit();
  run.wall_s = std::chrono::duration<double>{std::chrono::steady_clock::now() - started}.count();
  run.in_log = log.matches_done();
  run.matches = range.begin + run.in_log - first;
  run.complete = run.in_log == range.size();
  if (run.complete) log.finish();
  return run;
}

}  // namespace trivela::experiment
