#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "config/scenario/scenario.hpp"
#include "config/text/installation.hpp"
#include "experiment/play/play_match.hpp"

namespace trivela::experiment {
namespace {

using kicking::PolicyName;

constexpr std::uint32_t kPossessions = 12;
constexpr PolicyName kPolicies[] = {PolicyName::kStopped, PolicyName::kMoving, PolicyName::kPredictive};

MatchRecord played(const std::string& scenario, PolicyName policy, std::uint32_t match_id) {
  Arm arm;
  arm.policy = policy;
  MatchRecord record;
  PlayOptions every;
  every.every_cycle = true;
  play_match(config::load_scenario(config::shipped("scenarios/" + scenario)), arm, 1, match_id, kPossessions, every,
             &record);
  return record;
}

/// The simulator's possession of the robot at an instant in play: the last whose play had started by then.
std::uint32_t played_at(const MatchRecord& record, std::uint8_t robot_id, std::int64_t t_ns) {
  std::uint32_t number = 0;
  for (const msg::PossessionTruth& truth : record.possession_truths) {
    if (truth.robot_id == robot_id && truth.start_t_ns <= t_ns) number = truth.possession_id;
  }
  return number;
}

/// The number that a decision should have: a stop belongs to the possession that it prepares.
std::uint32_t true_number(const MatchRecord& record, const msg::KickDecision& decision) {
  const std::uint32_t played = played_at(record, decision.robot_id, decision.t_ns);
  return decision.reason == msg::REASON_NOT_PLAYING ? played + 1 : played;
}

/// Every decision with the ball is of the possession that the simulator counts then, stops included.
void expect_one_count(const std::string& scenario, std::uint32_t matches) {
  for (const PolicyName policy : kPolicies) {
    for (std::uint32_t match_id = 0; match_id < matches; ++match_id) {
      const MatchRecord record = played(scenario, policy, match_id);
      ASSERT_GT(record.decisions.size(), 10 * kPossessions);
      const auto alike = std::ranges::count_if(record.decisions, [&](const msg::KickDecision& decision) {
        return decision.possession_id == true_number(record, decision);
      });
      EXPECT_EQ(alike, std::ssize(record.decisions)) << kicking::name(policy) << " in match " << match_id;
      ASSERT_EQ(record.assignments.size(), kPossessions);
      for (std::uint32_t i = 0; i < kPossessions; ++i) {
        EXPECT_EQ(record.assignments[i].possession_id, i + 1);
        EXPECT_EQ(played_at(record, 1, record.assignments[i].t_ns), i + 1);
      }
    }
  }
}

TEST(OwnPossessions, WithoutNoiseARobotCountsAsTheSimulatorDoes) { expect_one_count("noise_free.toml", 12); }

TEST(OwnPossessions, WithTheNoiseOfTheDefaultWorldItDoesToo) { expect_one_count("default.toml", 12); }

TEST(OwnPossessions, EachRobotOfATeamCountsItsOwnAlone) {
  for (std::uint32_t match_id = 0; match_id < 4; ++match_id) {
    const MatchRecord record = played("team.toml", PolicyName::kMoving, match_id);
    std::map<int, std::uint32_t> had;  // by robot
    ASSERT_EQ(record.assignments.size(), kPossessions);
    for (std::uint32_t i = 0; i < kPossessions; ++i) {
      const Assignment& own = record.assignments[i];
      EXPECT_EQ(own.possession_id, ++had[own.robot_id]) << "robot " << int{own.robot_id};
      EXPECT_EQ(played_at(record, own.robot_id, own.t_ns), i + 1);
    }
    EXPECT_GT(had.size(), 2u);
  }
}

}  // namespace
}  // namespace trivela::experiment
