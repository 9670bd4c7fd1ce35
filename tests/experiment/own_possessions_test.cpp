#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "config/installation.hpp"
#include "config/scenario.hpp"
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

/// The simulator's possession of the robot that lasts at an instant: the first that ends later. 0: none does.
std::uint32_t true_number(const MatchRecord& record, std::uint8_t robot_id, std::int64_t t_ns) {
  const auto lasts = std::ranges::find_if(record.possession_truths, [&](const msg::PossessionTruth& truth) {
    return truth.robot_id == robot_id && truth.t_ns > t_ns;
  });
  return lasts == record.possession_truths.end() ? 0 : lasts->possession_id;
}

/// Every decision with the ball is of the possession that the simulator counts then, stops included.
void expect_one_count(const std::string& scenario, std::uint32_t matches) {
  for (const PolicyName policy : kPolicies) {
    for (std::uint32_t match_id = 0; match_id < matches; ++match_id) {
      const MatchRecord record = played(scenario, policy, match_id);
      ASSERT_GT(record.decisions.size(), 10 * kPossessions);
      const auto alike = std::ranges::count_if(record.decisions, [&](const msg::KickDecision& decision) {
        const std::uint32_t number = true_number(record, 1, decision.t_ns);
        return number == 0 || number == decision.possession_id;  // 0: the stop that closes the match
      });
      EXPECT_EQ(alike, std::ssize(record.decisions)) << kicking::name(policy) << " in match " << match_id;
      ASSERT_EQ(record.assignments.size(), kPossessions);
      for (std::uint32_t i = 0; i < kPossessions; ++i) {
        EXPECT_EQ(record.assignments[i].possession_id, i + 1);
        EXPECT_EQ(true_number(record, 1, record.assignments[i].t_ns), i + 1);
        EXPECT_GE(record.assignments[i].t_ns, record.possession_truths[i].start_t_ns) << "in play";
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
      EXPECT_EQ(true_number(record, own.robot_id, own.t_ns), i + 1);
    }
    EXPECT_GT(had.size(), 2u);
  }
}

}  // namespace
}  // namespace trivela::experiment
