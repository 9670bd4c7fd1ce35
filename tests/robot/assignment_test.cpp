#include "robot/decision/assignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "config/text/error.hpp"

namespace trivela::robot {
namespace {

using kicking::PolicyName;

config::KickDecision drawn(std::vector<double> probabilities = {}) {
  config::KickDecision settings;
  settings.random = {PolicyName::kStopped, PolicyName::kMoving, PolicyName::kPredictive};
  settings.random_probabilities = std::move(probabilities);
  return settings;
}

TEST(PolicyAssignment, TheHalfsPolicyIsInChargeAndTheLastGoesOn) {
  config::KickDecision settings;
  settings.policy_by_half = {PolicyName::kStopped, PolicyName::kMoving};
  const PolicyAssignment assignment{settings, 1};
  for (const int half : {0, 1}) EXPECT_EQ(assignment.in_charge(half, 3).policy, PolicyName::kStopped);
  for (const int half : {2, 3, 255}) EXPECT_EQ(assignment.in_charge(half, 3).policy, PolicyName::kMoving);
  EXPECT_EQ(assignment.in_charge(1, 3).probability, 1.0);
}

TEST(PolicyAssignment, ARobotsOwnPolicyGoesBeforeTheHalfs) {
  config::KickDecision settings;
  settings.policy_by_robot = {PolicyName::kStopped, PolicyName::kPredictive};
  EXPECT_EQ((PolicyAssignment{settings, 1}.in_charge(2, 1).policy), PolicyName::kStopped);
  EXPECT_EQ((PolicyAssignment{settings, 2}.in_charge(1, 1).policy), PolicyName::kPredictive);
  EXPECT_EQ((PolicyAssignment{settings, 3}.in_charge(1, 1).policy), PolicyName::kMoving) << "not named: by half";
}

TEST(PolicyAssignment, TheDrawDependsOnSeedRobotHalfAndPossessionAlone) {
  auto settings = drawn();
  std::map<PolicyName, int> by_seed, by_robot, by_half, by_possession;
  for (std::uint32_t i = 0; i < 40; ++i) {
    EXPECT_EQ((PolicyAssignment{settings, 2}.in_charge(1, i).policy),
              (PolicyAssignment{settings, 2}.in_charge(1, i).policy));
    ++by_possession[PolicyAssignment{settings, 2}.in_charge(1, i).policy];
    ++by_half[PolicyAssignment{settings, 2}.in_charge(static_cast<std::uint8_t>(1 + i), 1).policy];
    ++by_robot[PolicyAssignment{settings, static_cast<std::uint8_t>(1 + i)}.in_charge(1, 1).policy];
    settings.assignment_seed = i;
    ++by_seed[PolicyAssignment{settings, 2}.in_charge(1, 1).policy];
    settings.assignment_seed = 1;
  }
  for (const auto& counts : {by_seed, by_robot, by_half, by_possession}) EXPECT_EQ(counts.size(), 3u);
}

TEST(PolicyAssignment, DrawsAsOftenAsItSays) {
  const PolicyAssignment assignment{drawn({0.2, 0.0, 0.8}), 1};
  constexpr int kDraws = 20000;
  std::map<PolicyName, int> counts;
  for (int i = 0; i < kDraws; ++i) {
    const PolicyChance chance = assignment.in_charge(1, static_cast<std::uint32_t>(i));
    EXPECT_EQ(chance.probability, chance.policy == PolicyName::kStopped ? 0.2 : 0.8);
    ++counts[chance.policy];
  }
  EXPECT_EQ(counts.count(PolicyName::kMoving), 0u);
  EXPECT_NEAR(counts[PolicyName::kStopped], 0.2 * kDraws, 5.0 * std::sqrt(0.2 * 0.8 * kDraws));
}

TEST(PolicyAssignment, RefusesPoliciesThatMakeNoSenseTogether) {
  EXPECT_THROW((PolicyAssignment{drawn({0.5, 0.5}), 1}), config::Error) << "one probability is missing";
  EXPECT_THROW((PolicyAssignment{drawn({0.5, 0.5, 0.5}), 1}), config::Error) << "their sum";
  auto twice = drawn();
  twice.random.push_back(PolicyName::kStopped);
  EXPECT_THROW((PolicyAssignment{twice, 1}), config::Error);
  config::KickDecision none;
  none.policy_by_half.clear();
  EXPECT_THROW((PolicyAssignment{none, 1}), config::Error);
}

}  // namespace
}  // namespace trivela::robot
