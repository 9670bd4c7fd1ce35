#include <gtest/gtest.h>

#include <limits>

#include "tests/kicking/play.hpp"

namespace trivela::kicking {
namespace {

using tests::ready_at;

const PolicyConfig kStrict = tests::strict_config();

class EveryPolicy : public testing::TestWithParam<PolicyName> {
 protected:
  /// Cycles until the settling time of the stopped policy is over as well.
  PolicyOutput settled(PolicyInput input) {
    for (int i = 0; i < 14; ++i) {
      PolicyInput waiting = input;
      waiting.kicker_ready = false;
      waiting.t_ns += i * 20'000'000;
      evaluate(GetParam(), kStrict, {}, {}, waiting, memory_);
    }
    input.t_ns += 14 * 20'000'000;
    return evaluate(GetParam(), kStrict, {}, {}, input, memory_);
  }
  PolicyOutput now(const PolicyInput& input) { return evaluate(GetParam(), kStrict, {}, {}, input, memory_); }
  PolicyMemory memory_;
};

TEST_P(EveryPolicy, FiresWhenEveryConditionHolds) {
  const PolicyOutput output = settled(ready_at({0, 3, 0}));
  EXPECT_TRUE(output.fire);
  EXPECT_EQ(output.reason, Reason::kFire);
  EXPECT_TRUE(output.aligned);
  EXPECT_DOUBLE_EQ(output.distance_m, 5.73);
  EXPECT_NEAR(*output.v0_mps, 8.244355, 1e-6);
  EXPECT_NEAR(*output.power, 20 + 5 * (8.244355 - 7.33) / (8.39 - 7.33), 1e-5);
  EXPECT_NEAR(output.predicted->z_m, output.target_z_m, 1e-9);
  EXPECT_EQ(output.target_y_m, 9.0);
}

TEST_P(EveryPolicy, HoldsForEachConditionThatFails) {
  const auto reason = [&](auto spoil) {
    memory_ = {};
    PolicyInput input = ready_at({0, 3, 0});
    spoil(input);
    const PolicyOutput output = settled(input);
    EXPECT_FALSE(output.fire);
    return output.reason;
  };
  EXPECT_EQ(reason([](PolicyInput& i) { i.playing = false; }), Reason::kNotPlaying);
  EXPECT_EQ(reason([](PolicyInput& i) { i.possession = false; }), Reason::kNoBall);
  EXPECT_EQ(reason([](PolicyInput& i) { i.kicker_ready = false; }), Reason::kKickerNotReady);
  EXPECT_EQ(reason([](PolicyInput& i) { i.state_age_s = 0.15; }), Reason::kStaleState);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reason([&](PolicyInput& i) { i.state_age_s = nan; }), Reason::kStaleState);
  EXPECT_EQ(reason([&](PolicyInput& i) { i.pose.x_m = nan; }), Reason::kStaleState);
  EXPECT_EQ(reason([&](PolicyInput& i) { i.pose.heading_rad = nan; }), Reason::kStaleState);
  EXPECT_EQ(reason([&](PolicyInput& i) { i.twist.vy_mps = nan; }), Reason::kStaleState);
  EXPECT_EQ(reason([&](PolicyInput& i) { i.twist.omega_radps = INFINITY; }), Reason::kStaleState);
}

TEST_P(EveryPolicy, StandsStillWhileItMayNotPlay) {
  PolicyInput input = ready_at({0, 3, 0.7}, {1, 1, 1});
  input.playing = false;
  const Twist drive = now(input).drive;
  EXPECT_EQ(drive.vx_mps, 0.0);
  EXPECT_EQ(drive.vy_mps, 0.0);
  EXPECT_EQ(drive.omega_radps, 0.0);
}

TEST_P(EveryPolicy, WaitsForItsOrderAndTriesAgainIfTheBallStays) {
  PolicyInput input = ready_at({0, 3, 0});
  ASSERT_TRUE(settled(input).fire);
  const std::int64_t fired_t_ns = 14 * 20'000'000;
  for (int i = 1; i < 25; ++i) {
    input.t_ns = fired_t_ns + i * 20'000'000;
    EXPECT_EQ(now(input).reason, Reason::kOrderPending);
  }
  input.t_ns = fired_t_ns + 500'000'000;
  EXPECT_TRUE(now(input).fire);
}

TEST_P(EveryPolicy, StartsAfreshWithANewPossession) {
  PolicyInput input = ready_at({0, 3, 0});
  ASSERT_TRUE(settled(input).fire);
  input.possession_id = 2;
  input.t_ns = 15 * 20'000'000;
  EXPECT_EQ(now(input).reason, GetParam() == PolicyName::kMoving ? Reason::kFire : Reason::kSettling);
}

TEST_P(EveryPolicy, GivesTheSameAnswerToTheSameQuestion) {
  const PolicyInput input = ready_at({1, 4, 0.1}, {0.2, 1.0, -0.3});
  PolicyMemory other;
  const PolicyOutput a = now(input);
  const PolicyOutput b = evaluate(GetParam(), kStrict, {}, {}, input, other);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.v_kick_mps, b.v_kick_mps);
  EXPECT_EQ(a.drive.omega_radps, b.drive.omega_radps);
}

INSTANTIATE_TEST_SUITE_P(Policies, EveryPolicy, testing::Values(PolicyName::kStopped, PolicyName::kMoving),
                         [](const auto& policy) { return std::string(name(policy.param)); });

TEST(Names, AreTheWordsOfTheLog) {
  EXPECT_STREQ(name(PolicyName::kStopped), "stopped");
  EXPECT_STREQ(name(PolicyName::kMoving), "moving");
  EXPECT_STREQ(name(Reason::kFire), "fire");
  EXPECT_STREQ(name(Reason::kStaleState), "stale_state");
}

}  // namespace
}  // namespace trivela::kicking
