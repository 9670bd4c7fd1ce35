// Which kind of kick a robot with a lever chooses.
#include <gtest/gtest.h>

#include "tests/kicking/play.hpp"

namespace trivela::kicking {
namespace {

using tests::ready_at;

RobotModel with_flat() {
  RobotModel robot;
  RobotModel flat = robot;
  flat.exit_angle_rad = radians(6.0);
  robot.further_kinds.push_back(flat);
  return robot;
}

PolicyInput facing(double x_m, double keeper_x_m, std::uint8_t lever_kind) {
  PolicyInput input = ready_at({x_m, 3.0, 0.0}, {});
  input.keeper = KeeperPlace{keeper_x_m, 0.05};
  input.lever_kind = lever_kind;
  return input;
}

TEST(KickKind, OfARobotWithOneIsTheFirst) {
  for (const PolicyName policy : {PolicyName::kStopped, PolicyName::kMoving, PolicyName::kPredictive}) {
    PolicyMemory memory;
    const PolicyOutput output = evaluate(policy, {}, {}, {}, facing(0.0, 0.0, 0), memory);
    EXPECT_EQ(output.kick_kind, 0) << name(policy);
    EXPECT_EQ(output.lever_kind, 0) << name(policy);
  }
}

TEST(KickKind, PastAKeeperTheLeverIsWantedForTheFlatKickAndTheOrderIsOfTheKindThatItStandsFor) {
  const RobotModel robot = with_flat();
  PolicyMemory memory;
  const PolicyOutput up = evaluate(PolicyName::kPredictive, {}, robot, {}, facing(0.5, -0.4, 0), memory);
  EXPECT_EQ(up.kick_kind, 0) << "the lever is not there yet";
  EXPECT_EQ(up.lever_kind, 1) << "a flat ball leaves the keeper less time";
  EXPECT_EQ(up.reason, Reason::kWaiting);
  PolicyInput down = facing(0.5, -0.4, 1);
  down.t_ns += 300'000'000;
  const PolicyOutput flat = evaluate(PolicyName::kPredictive, {}, robot, {}, down, memory);
  EXPECT_EQ(flat.kick_kind, 1);
  EXPECT_EQ(flat.power, robot.kind(1).table.back().power);
  EXPECT_GT(*flat.p_goal, *up.p_goal);
}

TEST(KickKind, WhileTheLeverMovesNothingIsFired) {
  const RobotModel robot = with_flat();
  PolicyMemory memory;
  const PolicyOutput output = evaluate(PolicyName::kPredictive, {}, robot, {}, facing(0.5, -0.4, kLeverMoves), memory);
  EXPECT_FALSE(output.fire);
}

TEST(KickKind, OfAnOpponentAtTheBallIsTheOneThatTheLeverStandsFor) {
  const RobotModel robot = with_flat();
  PolicyInput input = facing(0.5, -0.4, 0);
  input.opponent_distance_m = 0.52;
  input.opponent_closing_mps = 1.5;
  PolicyMemory memory;
  const PolicyOutput output = evaluate(PolicyName::kPredictive, {}, robot, {}, input, memory);
  EXPECT_TRUE(output.fire) << "the ball is lost before the lever is there";
  EXPECT_EQ(output.kick_kind, 0);
}

TEST(KickKind, ALeverThatDoesNotComeIsGivenUpInThisPossession) {
  const RobotModel robot = with_flat();
  PolicyMemory memory;
  PolicyInput input = facing(0.5, -0.4, 0);
  PolicyOutput output;
  int fired = 0;
  for (int cycle = 0; cycle < 100; ++cycle) {
    if (cycle == 99) {
      input.opponent_distance_m = 0.52;
      input.opponent_closing_mps = 1.5;
    }
    output = evaluate(PolicyName::kPredictive, {}, robot, {}, input, memory);
    fired += output.fire ? 1 : 0;
    if (cycle < 25) {
      EXPECT_EQ(output.lever_kind, 1) << cycle;
    }
    input.t_ns += 20'000'000;
  }
  EXPECT_EQ(output.lever_kind, 0);
  EXPECT_GT(fired, 0) << "it kicks its lob";
  ++input.possession_id;
  input.opponent_distance_m = input.opponent_closing_mps = std::nullopt;
  EXPECT_EQ(evaluate(PolicyName::kPredictive, {}, robot, {}, input, memory).lever_kind, 1) << "tried again";
}

TEST(KickKind, StaysWhileAnOrderIsPending) {
  const RobotModel robot = with_flat();
  PolicyMemory memory;
  PolicyInput input = facing(0.5, -0.4, 1);
  input.opponent_distance_m = 0.52;
  input.opponent_closing_mps = 1.5;
  const PolicyOutput fired = evaluate(PolicyName::kPredictive, {}, robot, {}, input, memory);
  ASSERT_TRUE(fired.fire);
  ASSERT_EQ(fired.kick_kind, 1);
  input.t_ns += 20'000'000;
  input.keeper = KeeperPlace{0.9, 0.05};
  const PolicyOutput pending = evaluate(PolicyName::kPredictive, {}, robot, {}, input, memory);
  EXPECT_EQ(pending.reason, Reason::kOrderPending);
  EXPECT_EQ(pending.lever_kind, 1);
}

TEST(KickKind, WithADelayOfItsOwnReleasesFromWhereTheRobotIsThen) {
  RobotModel robot = with_flat();
  robot.further_kinds[0].delay_s = robot.delay_s + 0.05;
  PolicyInput input = facing(0.5, -0.4, 1);
  input.twist = {0.0, 1.0, 0.0};
  PolicyMemory memory;
  const PolicyOutput output = evaluate(PolicyName::kPredictive, {}, robot, {}, input, memory);
  ASSERT_TRUE(output.predicted);
  EXPECT_NEAR(output.predicted->release_m.y(), 3.0 + robot.ball_offset_m + robot.kind(1).delay_s, 0.03);
}

}  // namespace
}  // namespace trivela::kicking
