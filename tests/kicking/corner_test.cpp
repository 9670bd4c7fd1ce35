// How the policies play past a keeper.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/kicking/play.hpp"

namespace trivela::kicking {
namespace {

using tests::play;
using tests::ready_at;

constexpr PolicyName kPlay[] = {PolicyName::kStopped, PolicyName::kMoving, PolicyName::kPredictive};

PolicyInput past(const KeeperPlace& keeper, const Pose& pose, const Twist& twist = {}) {
  PolicyInput input = ready_at(pose, twist);
  input.keeper = keeper;
  return input;
}

TEST(Corner, EveryPolicyAimsInsideOfThePostThatItFaces) {
  const Goal goal;
  const double corner_m = goal.clean_half_width_m() - PolicyConfig{}.corner_margin_m;
  for (const PolicyName policy : kPlay)
    for (const double side : {-1.0, 1.0}) {
      // It faces a point beyond that corner from 5 m: a turn clockwise is to the right.
      const PolicyInput input = past({0.0, 0.05}, {0, 4, -side * 0.4});
      PolicyMemory memory;
      const PolicyOutput output = evaluate(policy, {}, {}, goal, input, memory);
      EXPECT_NEAR(output.target_x_m, side * corner_m, 1e-12) << name(policy);
    }
}

TEST(Corner, WithoutAKeeperOrForTheShotAloneNothingChanges) {
  PolicyConfig on_target;
  on_target.objective = Objective::kOnTarget;
  for (const PolicyName policy : kPlay)
    for (double heading = -1.0; heading <= 1.0; heading += 0.25) {
      const PolicyInput input = past({0.3, 0.05}, {0.5, 4, heading}, {0.2, 0.8, 0.5});
      PolicyInput nobody = input;
      nobody.keeper.reset();
      PolicyMemory a, b, c;
      const PolicyOutput plain = evaluate(policy, {}, {}, {}, nobody, a);
      for (const PolicyOutput& same :
           {evaluate(policy, on_target, {}, {}, input, b), evaluate(policy, on_target, {}, {}, nobody, c)}) {
        EXPECT_EQ(same.fire, plain.fire);
        EXPECT_EQ(same.target_x_m, plain.target_x_m);
        EXPECT_EQ(same.drive.omega_radps, plain.drive.omega_radps);
        EXPECT_EQ(same.drive.vy_mps, plain.drive.vy_mps);
        EXPECT_FALSE(same.p_goal);
      }
    }
}

TEST(Corner, PastAKeeperThatGuessesAllAimAtTheMiddleAndPredictiveWeighsGoals) {
  for (const PolicyName policy : kPlay) {
    PolicyMemory memory, nobodys;
    const PolicyInput input = past({0.0, 0.05, true}, {0.2, 4, -0.1});
    PolicyInput nobody = input;
    nobody.keeper.reset();
    const PolicyOutput output = evaluate(policy, {}, {}, {}, input, memory);
    EXPECT_EQ(output.target_x_m, 0.0) << name(policy);
    EXPECT_EQ(output.drive.vy_mps, evaluate(policy, {}, {}, {}, nobody, nobodys).drive.vy_mps) << name(policy);
    EXPECT_EQ(output.p_goal.has_value(), policy == PolicyName::kPredictive);
  }
}

TEST(Corner, TheGoalIsNeverLikelierThanTheTargetAndBothAreTold) {
  for (double y = 2.0; y <= 6.5; y += 0.5) {
    PolicyMemory memory;
    const PolicyOutput output = evaluate(PolicyName::kPredictive, {}, {}, {}, past({0.0, 0.05}, {0, y, 0.3}), memory);
    if (!output.p_on_target) continue;
    ASSERT_TRUE(output.p_goal) << y;
    EXPECT_LE(*output.p_goal, *output.p_on_target) << y;
  }
}

TEST(Corner, PredictiveKicksToTheSideThatTheKeeperLeaves) {
  for (const double side : {-1.0, 1.0}) {
    const Played played = play(PolicyName::kPredictive, {}, {}, past({-side * 0.4, 0.05}, {0, 4, 0}, {0, 1.0, 0}));
    ASSERT_TRUE(played.fired) << side;
    EXPECT_GT(side * played.fired->predicted->x_m, 0.4) << side;
    EXPECT_GT(*played.fired->p_goal, 0.4) << side;
  }
}

TEST(Corner, PredictiveGoesNearerThanWithoutAKeeper) {
  const Pose pose{0, 2, 0};
  PolicyInput nobody = ready_at(pose, {0, 1.0, 0});
  const Played alone = play(PolicyName::kPredictive, {}, {}, nobody);
  const Played kept = play(PolicyName::kPredictive, {}, {}, past({0.0, 0.05}, pose, {0, 1.0, 0}));
  ASSERT_TRUE(alone.fired && kept.fired);
  EXPECT_GT(kept.at.pose.y_m, alone.at.pose.y_m + 1.0);
}

TEST(Corner, StoppedAndMovingKeepTheirCorner) {
  for (const PolicyName policy : {PolicyName::kStopped, PolicyName::kMoving}) {
    PolicyMemory memory;
    PolicyInput input = past({0.0, 0.05}, {0, 4, 0.05});
    const double first = evaluate(policy, {}, {}, {}, input, memory).target_x_m;
    input.pose.heading_rad = -0.3;  // nearer to the other one
    input.t_ns += 20'000'000;
    EXPECT_EQ(evaluate(policy, {}, {}, {}, input, memory).target_x_m, first);
    ++input.possession_id;
    EXPECT_EQ(evaluate(policy, {}, {}, {}, input, memory).target_x_m, -first) << "a new possession";
  }
}

TEST(Corner, AKeeperThatIsFirstSeenAfterTheOrderChangesNoAim) {
  PolicyMemory memory;
  PolicyInput input = ready_at({0, 4, 0}, {0, 1.2, 0});
  const PolicyOutput fired = evaluate(PolicyName::kPredictive, {}, {}, {}, input, memory);
  ASSERT_TRUE(fired.fire);
  input.keeper = KeeperPlace{0.0, 0.05};
  input.t_ns += 20'000'000;
  const PolicyOutput pending = evaluate(PolicyName::kPredictive, {}, {}, {}, input, memory);
  EXPECT_EQ(pending.reason, Reason::kOrderPending);
  EXPECT_EQ(pending.target_x_m, fired.target_x_m) << "the kick was reckoned with this way of driving";
  input.t_ns += 1'000'000'000;  // it was refused
  EXPECT_NE(evaluate(PolicyName::kPredictive, {}, {}, {}, input, memory).target_x_m, 0.0) << "a corner";
}

}  // namespace
}  // namespace trivela::kicking
