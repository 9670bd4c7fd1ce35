#include "nodes/in_process/play_match.hpp"

#include <gtest/gtest.h>

#include <set>

namespace trivela::nodes {
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

TEST(PlayMatch, RefusesWhatCannotBePlayed) {
  EXPECT_THROW(play_match({}, arm(PolicyName::kMoving), 1, 0, 0), std::runtime_error) << "no possessions";
  Arm fast = arm(PolicyName::kMoving);
  fast.settings.run.cycle_s = 0.01;
  EXPECT_THROW(played(fast), std::runtime_error) << "another cycle than the world's";
  Arm nobody = arm(PolicyName::kMoving);
  nobody.robots.clear();
  EXPECT_THROW(played(nobody), std::runtime_error);
}

TEST(MatchSeed, FitsTheSeedsOfAMatchAndDiffers) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed : {0, 1, 2})
    for (std::uint32_t match = 0; match < 100; ++match) seeds.insert(match_seed(seed, match));
  EXPECT_EQ(seeds.size(), 300u);
  EXPECT_LT(*seeds.rbegin(), std::uint64_t{1} << 52);
}

}  // namespace
}  // namespace trivela::nodes
