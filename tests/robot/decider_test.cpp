#include "robot/decision/decider.hpp"

#include <gtest/gtest.h>

#include "config/robot.hpp"
#include "idl/messages.hpp"
#include "kicking/kick_id.hpp"
#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

constexpr std::uint32_t kSession = 5;

/// A robot 6 m before the goal at rest with the ball, aligned, whose policy kicks at once.
struct Robot {
  Robot() { settings.kick_decision.policy_by_half = {kicking::PolicyName::kMoving}; }

  const CycleDecision& cycle() {
    const CycleDecision& decision = judged();
    decider.commit();
    return decision;
  }
  /// Without commit().
  const CycleDecision& judged() {
    world.t_ns += kCycle_ns;
    kicker.t_ns = world.t_ns;
    return decider.decide(world, &kicker, std::nullopt);
  }

  void driver_accepts(std::int64_t kick_id) {
    kicker.last_kick_id = kick_id;
    kicker.last_accepted = true;
  }

  config::Settings settings;
  config::Robot robot;
  Decider decider{{settings.kick_decision, settings.policy, settings.goal}, robot.model, 1, kSession};
  msg::WorldState world = [] {
    msg::WorldState out{};
    out.half = 1;
    out.playing = out.possession = out.ball_known = true;
    out.possession_id = 1;
    out.y_m = 3.0;
    out.opponent_distance_m = msg::kNone;
    return out;
  }();
  msg::KickerStatus kicker = [] {
    msg::KickerStatus out{};
    out.ready = true;
    return out;
  }();
};

std::int64_t kick_of_the_other_node() { return kicking::KickId{kSession + 1, 1, 1}.number(); }

TEST(Decider, AKickThatTheOtherNodeOrderedIsUnderWayForThisOneToo) {
  Robot robot;
  robot.driver_accepts(kick_of_the_other_node());
  const CycleDecision& decision = robot.cycle();
  EXPECT_FALSE(decision.order);
  EXPECT_EQ(decision.output.reason, kicking::Reason::kKickerNotReady);
}

TEST(Decider, WhatIsNotCommittedIsDecidedAgainWithTheSameNumber) {
  Robot robot;
  const msg::KickOrder first = robot.judged().order.value();
  const msg::KickOrder again = robot.judged().order.value();
  EXPECT_EQ(again.kick_id, first.kick_id);
  EXPECT_EQ(robot.decider.orders(), 0u);
  robot.decider.commit();
  robot.decider.commit();
  EXPECT_EQ(robot.decider.orders(), 1u);
  EXPECT_EQ(robot.decider.record(robot.world, &robot.kicker).seq, 1u) << "the two before count for nothing";
  EXPECT_FALSE(robot.judged().order) << "the order is under way";
  EXPECT_EQ(robot.decider.last_order_t_ns(), again.t_ns);
}

TEST(Decider, AKickOfTheOtherNodeThatTheDriverRefusedHoldsNothingBack) {
  Robot robot;
  robot.driver_accepts(kick_of_the_other_node());
  robot.kicker.last_accepted = false;
  EXPECT_TRUE(robot.cycle().order);
}

TEST(Decider, AKickOfTheOtherNodeIsMindedForAsLongAsAnOrderAndNoLonger) {
  Robot robot;
  robot.driver_accepts(kick_of_the_other_node());
  int held = 0;
  while (!robot.cycle().order && held < 1000) ++held;
  EXPECT_NEAR(held * 0.02, robot.settings.policy.order_hold_s, 0.021);
}

/// Possessions of a robot that faces the right corner, past a keeper that has gone `gone_m` half a second after each
/// kick. Where the last one aims.
double aims_at_x_m(int possessions, double gone_m, bool accepted = true) {
  Robot robot;
  robot.world.x_m = 0.74;
  double target_x_m = 0.0;
  for (int i = 0; i < possessions; ++i) {
    ++robot.world.possession_id;
    robot.world.possession = true;
    robot.world.keeper_x_m = 0.0;
    robot.world.keeper_sd_m = 0.08;
    const CycleDecision& decision = robot.cycle();
    target_x_m = decision.output.target_x_m;
    if (!decision.order) break;
    if (accepted) robot.driver_accepts(decision.order->kick_id);
    robot.world.possession = false;
    for (int cycle = 0; cycle < 40; ++cycle) {
      robot.world.keeper_x_m = cycle < 20 ? 0.0 : gone_m;
      robot.cycle();
    }
  }
  return target_x_m;
}

TEST(Decider, AimsAtTheMiddleOfAKeeperThatWasSeenToJump) {
  EXPECT_NEAR(aims_at_x_m(1, -0.32), 0.74, 1e-9);
  EXPECT_EQ(aims_at_x_m(3, -0.32), 0.0);
  EXPECT_NEAR(aims_at_x_m(3, 0.0), 0.74, 1e-9) << "it waits";
  EXPECT_NEAR(aims_at_x_m(3, -0.32, false), 0.74, 1e-9) << "no kick: it jumped for nothing";
}

TEST(Decider, ItsOwnAcceptedKickIsNoKickOfAnother) {
  Robot robot;
  const std::int64_t kick_id = robot.cycle().order.value().kick_id;
  int held = 0;
  for (robot.driver_accepts(kick_id); !robot.cycle().order && held < 1000;) ++held;
  EXPECT_NEAR((held + 1) * 0.02, robot.settings.policy.order_hold_s, 0.021)
      << "counted from the order, not from its status";
}

TEST(Decider, SaysWhetherAPolicyThatMayBeAskedReadsWhereOpponentsAre) {
  const config::Robot robot;
  config::Settings settings;
  const auto reads = [&](kicking::PolicyName policy, bool shadows) {
    settings.kick_decision.policy_by_half = {policy};
    settings.kick_decision.shadows = shadows;
    return Decider{{settings.kick_decision, settings.policy, settings.goal}, robot.model, 1, kSession}
        .reads_opponents();
  };
  EXPECT_FALSE(reads(kicking::PolicyName::kMoving, false));
  EXPECT_FALSE(reads(kicking::PolicyName::kStopped, false));
  EXPECT_TRUE(reads(kicking::PolicyName::kPredictive, false));
  EXPECT_TRUE(reads(kicking::PolicyName::kMoving, true)) << "predictive rides along";
}

}  // namespace
}  // namespace trivela::robot
