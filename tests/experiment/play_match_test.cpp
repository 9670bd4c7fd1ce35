#include "experiment/play/play_match.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "config/scenario/scenario.hpp"
#include "config/text/installation.hpp"

namespace trivela::experiment {
namespace {

using kicking::PolicyName;

constexpr std::uint32_t kPossessions = 30;

Arm arm(PolicyName policy) {
  Arm arm;
  arm.name = kicking::name(policy);
  arm.policy = policy;
  return arm;
}

PlayedMatch played(const Arm& arm, std::uint32_t match_id = 0, MatchRecord* record = nullptr,
                   const PlayOptions& options = {}) {
  return play_match({}, arm, 1, match_id, kPossessions, options, record);
}

int kicks(const PlayedMatch& match) {
  int n = 0;
  for (const PlayedPossession& possession : match.possessions) n += possession.kick.has_value();
  return n;
}

TEST(PlayMatch, EveryPossessionIsPlayedOnceInItsOrder) {
  const PlayedMatch match = played(arm(PolicyName::kMoving), 7);
  ASSERT_EQ(match.possessions.size(), kPossessions);
  EXPECT_EQ(match.match_seed, match_seed(1, 7));
  for (std::uint32_t i = 0; i < kPossessions; ++i) {
    const PlayedPossession& possession = match.possessions[i];
    EXPECT_EQ(possession.possession_id, i + 1);
    EXPECT_EQ(possession.match_id, 7u);
    EXPECT_EQ(possession.policy, PolicyName::kMoving);
    EXPECT_EQ(possession.assignment_probability, 1.0);
    EXPECT_GT(possession.played_s, 0.0);
    EXPECT_GT(possession.start_distance_m, 2.9);
    EXPECT_LT(possession.start_distance_m, 9.5);
    EXPECT_EQ(possession.kick.has_value() && possession.kick->truth.has_value(),
              possession.ending == sim::PossessionEnd::kKicked);
  }
  EXPECT_GT(kicks(match), 5);
}

TEST(PlayMatch, TheSamePossessionIsTheSameSituationForEveryArm) {
  const PlayedMatch stopped = played(arm(PolicyName::kStopped));
  const PlayedMatch moving = played(arm(PolicyName::kMoving));
  for (std::uint32_t i = 0; i < kPossessions; ++i)
    EXPECT_EQ(stopped.possessions[i].start_distance_m, moving.possessions[i].start_distance_m);
  EXPECT_LT(kicks(stopped), kicks(moving));
  const PlayedMatch other = played(arm(PolicyName::kMoving), 1);
  EXPECT_NE(other.possessions[0].start_distance_m, moving.possessions[0].start_distance_m);
}

TEST(PlayMatch, RecordingAndShadowsChangeNothing) {
  MatchRecord record;
  const PlayedMatch alone = played(arm(PolicyName::kStopped));
  const PlayedMatch watched = played(arm(PolicyName::kStopped), 0, &record, {.shadows = true, .every_cycle = true});
  ASSERT_EQ(alone.possessions.size(), watched.possessions.size());
  EXPECT_EQ(alone.end_t_ns, watched.end_t_ns);
  for (std::uint32_t i = 0; i < kPossessions; ++i) {
    const auto& a = alone.possessions[i].kick;
    const auto& b = watched.possessions[i].kick;
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    EXPECT_EQ(a->power, b->power);
    EXPECT_EQ(a->observed, b->observed);
    EXPECT_EQ(a->truth, b->truth);
  }
  EXPECT_GT(record.decisions.size(), 500u);
  EXPECT_EQ(record.decisions.front().shadow_count, 2);
  EXPECT_EQ(record.orders.size(), record.receipts.size());
  EXPECT_EQ(record.possession_truths.size(), kPossessions);
  EXPECT_EQ(record.assignments.size(), kPossessions);
}

TEST(PlayMatch, TheOracleKnowsMoreThanTheRobots) {
  const auto hits = [](const Arm& arm) {
    int n = 0;
    for (std::uint32_t match = 0; match < 4; ++match) {
      for (const PlayedPossession& possession : played(arm, match).possessions)
        n += possession.kick && possession.kick->truth == kicking::Outcome::kOnTarget;
    }
    return n;
  };
  EXPECT_GT(hits(arm(PolicyName::kOracle)), hits(arm(PolicyName::kStopped)));
}

TEST(PlayMatch, TheOldTableIsAnotherOneInEachMatch) {
  Arm old = arm(PolicyName::kMoving);
  old.table = kOldTable;
  MatchRecord by_hand, calibrated;
  played(old, 0, &by_hand);
  played(arm(PolicyName::kMoving), 0, &calibrated);
  ASSERT_FALSE(by_hand.orders.empty());
  ASSERT_FALSE(calibrated.orders.empty());
  EXPECT_NE(by_hand.orders[0].power, calibrated.orders[0].power);
}

TEST(PlayMatch, OnlyWhoAimsByALawReadsTheOldTableByIt) {
  const auto speed_of = [](PolicyName policy, kicking::HeightLaw law) {
    Arm old = arm(policy);
    old.table = kOldTable;
    old.settings.policy.height_law = law;
    return robot_of({}, old, 1, 0, 1).model.table.back().speed_mps;
  };
  const auto paper = kicking::HeightLaw::kPaper, exact = kicking::HeightLaw::kExact;
  for (const PolicyName by_law : {PolicyName::kStopped, PolicyName::kMoving})
    EXPECT_LT(speed_of(by_law, paper), speed_of(by_law, exact) - 0.1) << "the same powers in play";
  EXPECT_EQ(speed_of(PolicyName::kPredictive, paper), speed_of(PolicyName::kPredictive, exact));
  EXPECT_EQ(speed_of(PolicyName::kPredictive, paper), speed_of(PolicyName::kMoving, exact))
      << "as high as the balls were";
}

TEST(PlayMatch, EachRobotOfATeamHasItsOwnModel) {
  sim::Scenario scenario;
  scenario.team.robots = 3;
  Arm team = arm(PolicyName::kMoving);
  team.robots.resize(2);
  MatchRecord record;
  play_match(scenario, team, 1, 0, kPossessions, {}, &record);
  std::set<int> robots;
  for (const msg::PossessionTruth& truth : record.possession_truths) robots.insert(truth.robot_id);
  EXPECT_EQ(robots, (std::set<int>{1, 2, 3}));
  for (const msg::KickOrder& order : record.orders) EXPECT_EQ(order.kick_id >> 40 & 0xff, order.robot_id);
}

/// A match of a team of three that plays by what the settings of an arm without a policy say.
MatchRecord played_by(const config::KickDecision& decision) {
  sim::Scenario scenario;
  scenario.team.robots = 3;
  Arm team;
  team.policy.reset();
  team.settings.kick_decision = decision;
  MatchRecord record;
  play_match(scenario, team, 1, 0, kPossessions, {}, &record);
  EXPECT_EQ(record.assignments.size(), kPossessions);
  return record;
}

TEST(PlayMatch, GoalAndRulesAreTheScenarios) {
  const sim::Scenario scenario = config::load_scenario(config::shipped("scenarios/msl_2026.toml"));
  for (const PolicyName policy : {PolicyName::kStopped, PolicyName::kMoving, PolicyName::kPredictive}) {
    MatchRecord record;
    play_match(scenario, arm(policy), 1, 0, kPossessions, {}, &record);
    ASSERT_FALSE(record.decisions.empty());
    for (const msg::KickDecision& decision : record.decisions) EXPECT_EQ(decision.target_y_m, 11.0);
  }
}

TEST(PlayMatch, NoPolicyBreaksTheRulesThatItPlaysBy) {
  sim::Scenario scenario = config::load_scenario(config::shipped("scenarios/msl_2026.toml"));
  scenario.referee.stops_per_min = 0.0;  // who is stopped carried the ball too far
  scenario.possession.goal_distance_max_m = 14.0;
  scenario.opponent.distance_median_m = 4.0;
  for (const PolicyName policy : {PolicyName::kStopped, PolicyName::kMoving, PolicyName::kPredictive}) {
    MatchRecord record;
    PlayOptions every;
    every.every_cycle = true;
    const PlayedMatch match = play_match(scenario, arm(policy), 1, 0, kPossessions, every, &record);
    int held = 0;
    for (const msg::KickDecision& decision : record.decisions) held += decision.reason == msg::REASON_OWN_HALF;
    EXPECT_GT(held, 50) << kicking::name(policy);
    EXPECT_GT(kicks(match), 3) << kicking::name(policy);
    for (const PlayedPossession& possession : match.possessions)
      EXPECT_NE(possession.ending, sim::PossessionEnd::kStopped) << kicking::name(policy) << possession.possession_id;
    for (const msg::KickTruth& kick : record.kick_truths) EXPECT_GT(kick.release_y_m, 0.0) << kicking::name(policy);
  }
}

TEST(PlayMatch, ASetPieceIsTakenBeforeItsTimeIsOver) {
  sim::Scenario scenario;
  scenario.referee.set_pieces = true;
  scenario.referee.stops_per_min = 0.0;
  scenario.rules.set_piece_s = 7.0;
  scenario.opponent.distance_median_m = 30.0;  // nobody hurries the robot but the referee
  scenario.opponent.distance_sigma_ln = 0.0;
  scenario.possession.time_limit_s = 30.0;
  for (const PolicyName policy : {PolicyName::kStopped, PolicyName::kMoving, PolicyName::kPredictive}) {
    MatchRecord record;
    const PlayedMatch match = play_match(scenario, arm(policy), 1, 0, kPossessions, {}, &record);
    EXPECT_GT(kicks(match), static_cast<int>(kPossessions) * 9 / 10) << kicking::name(policy);
    std::map<std::uint32_t, std::int64_t> started_t_ns;
    for (const msg::PossessionTruth& truth : record.possession_truths)
      started_t_ns[truth.possession_id] = truth.start_t_ns;
    for (const msg::KickTruth& kick : record.kick_truths)
      EXPECT_LE(kick.release_t_ns - started_t_ns.at(kick.possession_id), 7'100'000'000) << kicking::name(policy);
  }
}

TEST(PlayMatch, SettingsSayWhoPlaysRobotByRobot) {
  config::KickDecision decision;
  decision.policy_by_robot = {PolicyName::kStopped, PolicyName::kOracle};
  decision.policy_by_half = {PolicyName::kPredictive};
  const PolicyName policies[] = {PolicyName::kStopped, PolicyName::kOracle, PolicyName::kPredictive};
  std::set<int> robots;
  const MatchRecord record = played_by(decision);
  for (const Assignment& row : record.assignments) {
    EXPECT_EQ(row.policy, policies[row.robot_id - 1]) << "robot " << int{row.robot_id};
    EXPECT_EQ(row.probability, 1.0);
    robots.insert(row.robot_id);
  }
  EXPECT_EQ(robots.size(), 3u);
}

TEST(PlayMatch, SettingsDrawThePoliciesLikeTheArmDoes) {
  config::KickDecision decision;
  decision.random = {PolicyName::kStopped, PolicyName::kMoving};
  decision.random_probabilities = {0.25, 0.75};
  const MatchRecord by_settings = played_by(decision);
  sim::Scenario scenario;
  scenario.team.robots = 3;
  Arm drawn;
  drawn.random = {{PolicyName::kStopped, 0.25}, {PolicyName::kMoving, 0.75}};
  MatchRecord by_arm;
  play_match(scenario, drawn, 1, 0, kPossessions, {}, &by_arm);
  ASSERT_EQ(by_arm.assignments.size(), kPossessions);
  std::set<PolicyName> policies;
  for (std::uint32_t i = 0; i < kPossessions; ++i) {
    EXPECT_EQ(by_settings.assignments[i].policy, by_arm.assignments[i].policy);
    EXPECT_EQ(by_settings.assignments[i].probability, by_arm.assignments[i].probability);
    policies.insert(by_arm.assignments[i].policy);
  }
  EXPECT_EQ(policies.size(), 2u);
}

TEST(PlayMatch, KnowsWhereOnePolicyPlaysAll) {
  sim::Scenario scenario;
  scenario.team.robots = 2;
  Arm team = arm(PolicyName::kStopped);
  EXPECT_EQ(only_policy(scenario, team), PolicyName::kStopped);
  team.policy.reset();
  EXPECT_EQ(only_policy(scenario, team), PolicyName::kMoving) << "the settings' half";
  team.settings.kick_decision.policy_by_robot = {PolicyName::kStopped};
  EXPECT_EQ(only_policy(scenario, team), std::nullopt);
  EXPECT_EQ(only_policy({}, team), PolicyName::kStopped) << "there is no second robot";
  team.settings.kick_decision.random = {PolicyName::kStopped, PolicyName::kMoving};
  EXPECT_EQ(only_policy({}, team), std::nullopt);
}

TEST(PlayMatch, RefusesWhatCannotBePlayed) {
  EXPECT_THROW(play_match({}, arm(PolicyName::kMoving), 1, 0, 0), std::runtime_error) << "no possessions";
  Arm fast = arm(PolicyName::kMoving);
  fast.settings.run.cycle_s = 0.01;
  EXPECT_THROW(played(fast), std::runtime_error) << "another cycle than the world's";
  Arm nobody = arm(PolicyName::kMoving);
  nobody.robots.clear();
  EXPECT_THROW(played(nobody), std::runtime_error);
  Arm drawn = arm(PolicyName::kMoving);
  drawn.random = {{PolicyName::kStopped, 0.5}, {PolicyName::kMoving, 0.75}};
  EXPECT_THROW(check_playable({}, drawn, 1), std::runtime_error) << "the probabilities' sum";
  sim::Scenario broken;
  broken.team.robots = 2.5;
  EXPECT_THROW(check_playable(broken, arm(PolicyName::kMoving), 1), std::runtime_error);
  EXPECT_NO_THROW(check_playable({}, arm(PolicyName::kMoving), 1));
}

TEST(MatchSeed, FitsTheSeedsOfAMatchAndDiffers) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed : {0, 1, 2})
    for (std::uint32_t match = 0; match < 100; ++match) seeds.insert(match_seed(seed, match));
  EXPECT_EQ(seeds.size(), 300u);
  EXPECT_LT(*seeds.rbegin(), std::uint64_t{1} << 52);
}

}  // namespace
}  // namespace trivela::experiment
