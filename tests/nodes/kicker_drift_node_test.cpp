// A kicker that changes, as its robot's own messages tell it.
#include "nodes/kicker_drift/kicker_drift_node.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "idl/messages.hpp"
#include "tests/instants.hpp"
#include "tests/nodes/node_fixture.hpp"

namespace trivela::nodes {
namespace {

using bus::Executor;

/// A kick 6 m before the line that was predicted at 0.8 m of height, and was `higher_m` than that.
struct Kick {
  std::int64_t kick_id = 0;
  double higher_m = 0.0;

  std::int64_t t_ns() const { return kick_id * kSecond_ns; }
  msg::KickDecision decision(bool fire = true) const {
    msg::KickDecision decision{};
    decision.t_ns = t_ns();
    decision.kick_id = fire ? kick_id : 0;
    decision.fire = fire;
    decision.y_m = 3.0;
    decision.target_y_m = 9.0;
    decision.predicted_z_cross_m = 0.8;
    decision.predicted_t_flight_s = 0.9;
    return decision;
  }
  msg::KickReceipt receipt(bool accepted = true) const {
    msg::KickReceipt receipt{};
    receipt.t_ns = t_ns();
    receipt.kick_id = kick_id;
    receipt.accepted = accepted;
    receipt.refusal = accepted ? msg::REFUSAL_NONE : msg::REFUSAL_CHARGING;
    receipt.release_t_ns = accepted ? t_ns() + 10'000'000 : 0;
    return receipt;
  }
  msg::KickOutcome outcome(msg::Outcome what = msg::OUTCOME_ON_TARGET) const {
    msg::KickOutcome outcome{};
    outcome.t_ns = t_ns() + kSecond_ns / 2;
    outcome.kick_id = kick_id;
    outcome.outcome = what;
    outcome.z_cross_m = 0.8 + higher_m;
    outcome.exit_speed_mps = msg::kNone;
    return outcome;
  }
};

/// Kicks from 1 on that scatter by 0.1 m, 0.7 m lower from kick 41 on.
std::vector<Kick> failing_kicks(std::int64_t n) {
  std::mt19937 random(4);
  std::normal_distribution<double> scatter_m(0.0, 0.1);
  std::vector<Kick> kicks;
  for (std::int64_t id = 1; id <= n; ++id) kicks.push_back({id, scatter_m(random) - (id > 40 ? 0.7 : 0.0)});
  return kicks;
}

class KickerDriftNodeTest : public NodeTest {
 protected:
  void start() {
    node.emplace(context);
    running.emplace(Executor::kListener, stop, std::vector<bus::Node*>{&node->node()});
  }
  void kick(const Kick& kick) {
    decision(kick.decision(false));
    decision(kick.decision());
    receipt(kick.receipt());
    outcome(kick.outcome());
  }

  Received<msg::KickerDrift> drift{participant};
  Says<msg::KickDecision> decision{participant};
  Says<msg::KickReceipt> receipt{participant};
  Says<msg::KickOutcome> outcome{participant};
  std::optional<KickerDriftNode> node;
  std::optional<Running> running;
};

TEST_F(KickerDriftNodeTest, SaysAtWhichKickTheKickerChangedAndWhatToDo) {
  start();
  for (const Kick& one : failing_kicks(60)) kick(one);
  const msg::KickerDrift said = drift.nth(1);
  EXPECT_EQ(drift.now().size(), 1u) << "once";
  EXPECT_EQ(said.robot_id, 1);
  EXPECT_EQ(said.seq, 1u);
  EXPECT_EQ(said.changes, 1u);
  EXPECT_EQ(said.changed_kick_id, 41);
  EXPECT_GE(said.found_kick_id, 41);
  EXPECT_LE(said.found_kick_id, 46);
  EXPECT_EQ(said.t_ns, said.found_kick_id * kSecond_ns);
  EXPECT_EQ(said.kind, msg::DRIFT_EXIT_SPEED);
  EXPECT_LT(said.factor, 0.95);
  EXPECT_GT(said.factor, 0.85);
  EXPECT_EQ(said.table_factor, said.factor);
  EXPECT_GT(said.factor_se, 0.0);
  EXPECT_NEAR(said.height_m, -0.7, 0.2);
  EXPECT_TRUE(log_lines->wait_for("the kicker changed at kick 41: exit speed fell by"));
}

TEST_F(KickerDriftNodeTest, SaysNothingOfAKickerThatIsWhatItWas) {
  start();
  for (const Kick& one : failing_kicks(40)) kick(one);
  EXPECT_TRUE(drift.now().empty());
}

TEST_F(KickerDriftNodeTest, TellsWhoJoinsLater) {
  start();
  for (const Kick& one : failing_kicks(60)) kick(one);
  drift.nth(1);
  Received<msg::KickerDrift> late{participant};
  EXPECT_EQ(late.nth(1).changed_kick_id, 41);
}

TEST_F(KickerDriftNodeTest, WordsOfAKickMayComeInAnyOrder) {
  start();
  for (const Kick& one : failing_kicks(60)) {
    outcome(one.outcome());
    receipt(one.receipt());
    decision(one.decision());
  }
  EXPECT_EQ(drift.nth(1).changed_kick_id, 41);
}

TEST_F(KickerDriftNodeTest, AKickThatARestartedDriverTakesBackIsNoSignOfAChange) {
  start();
  for (const Kick& one : failing_kicks(60)) {
    decision(one.decision());
    msg::KickReceipt accepted = one.receipt();
    accepted.seq = 100 + static_cast<std::uint64_t>(one.kick_id);
    receipt(accepted);
    if (one.kick_id > 40) {
      msg::KickReceipt not_fired = one.receipt(false);
      not_fired.seq = 1;
      not_fired.t_ns += kSecond_ns / 4;
      receipt(not_fired);
    }
    outcome(one.outcome());
  }
  EXPECT_TRUE(drift.now().empty());
}

TEST_F(KickerDriftNodeTest, WhatWasRefusedOrNotSeenIsNoSignOfAChange) {
  start();
  for (const Kick& one : failing_kicks(60)) {
    const bool after = one.kick_id > 40;
    decision(one.decision());
    receipt(one.receipt(!after || one.kick_id % 2 == 0));
    outcome(one.outcome(after ? msg::OUTCOME_UNKNOWN : msg::OUTCOME_ON_TARGET));
  }
  EXPECT_TRUE(drift.now().empty());
}

TEST_F(KickerDriftNodeTest, TakesBackWhatALaterWordOnTheKicksRefutes) {
  start();
  const auto kicks = failing_kicks(60);
  for (const Kick& one : kicks) kick(one);
  drift.nth(1);
  for (const Kick& one : kicks)
    if (one.kick_id > 40) outcome(one.outcome(msg::OUTCOME_BLOCKED));
  const auto& said = drift.now();
  ASSERT_GE(said.size(), 2u);
  EXPECT_EQ(said.back().changes, 0u);
  EXPECT_EQ(said.back().changed_kick_id, 0);
  EXPECT_TRUE(std::isnan(said.back().factor));
  EXPECT_EQ(said.back().seq, said.size());
}

TEST_F(KickerDriftNodeTest, HearsItsOwnRobotAlone) {
  start();
  Says<msg::KickDecision> other_decision{participant, 2};
  Says<msg::KickReceipt> other_receipt{participant, 2};
  Says<msg::KickOutcome> other_outcome{participant, 2};
  for (const Kick& one : failing_kicks(60)) {
    other_decision(one.decision());
    other_receipt(one.receipt());
    other_outcome(one.outcome());
  }
  EXPECT_TRUE(drift.now().empty());
}

TEST_F(KickerDriftNodeTest, NobodyWaitsForIt) {
  const bus::Writer<msg::KickDecision> decisions{participant};
  const bus::Writer<msg::KickReceipt> receipts{participant};
  const bus::Writer<msg::KickOutcome> outcomes{participant};
  start();
  EXPECT_EQ(decisions.readers(), 0u);
  EXPECT_EQ(receipts.readers(), 0u);
  EXPECT_EQ(outcomes.readers(), 0u);
}

TEST_F(KickerDriftNodeTest, InstantsThatAreNoneAreNoKicks) {
  start();
  for (Kick one : failing_kicks(60)) {
    auto early = one.decision();
    early.t_ns = std::numeric_limits<std::int64_t>::min();
    decision(early);
    auto released = one.receipt();
    released.release_t_ns = -1;
    receipt(released);
    outcome(one.outcome());
  }
  EXPECT_TRUE(drift.now().empty());
}

}  // namespace
}  // namespace trivela::nodes
