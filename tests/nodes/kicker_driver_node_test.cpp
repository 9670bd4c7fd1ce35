#include "nodes/kicker_driver/kicker_driver_node.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "tests/nodes/node_fixture.hpp"

namespace trivela::nodes {
namespace {

using bus::Executor;

class KickerDriverNodeTest : public NodeTest {
 protected:
  void start(Executor::Kind kind = Executor::kListener) {
    long_ago();
    node.emplace(context, fake_kicker());
    clock_ns = t_ns;
    running.emplace(kind, stop, std::vector<bus::Node*>{&node->node()});
    order.expect_reader();
  }

  /// A driver that began then has rested, whoever fired before it.
  void long_ago() { clock_ns = t_ns - kicking::nanoseconds(context.settings.run.cycle_s + 1.0); }
  msg::KickerStatus sample(double charge = 1.0, bool armed = true, hal::KickerFault fault = hal::KickerFault::kNone,
                           std::int64_t after_ns = 20'000'000) {
    clock_ns = t_ns += after_ns;
    kicker->put({t_ns, charge, armed, fault});
    return status.nth(++samples);
  }
  void play(bool playing = true) {
    msg::Referee word{};
    word.t_ns = t_ns;
    word.playing = playing;
    (*referee)(word);
    drive({});  // the decision node is there
  }
  msg::KickOrder wish(std::int64_t kick_id, double power = 30.0) const {
    msg::KickOrder out{};
    out.t_ns = out.fire_t_ns = t_ns;
    out.valid_until_t_ns = t_ns + 50'000'000;
    out.kick_id = kick_id;
    out.power = power;
    out.possession = true;
    return out;
  }
  /// What a driver before this one said of kick 41.
  static msg::KickReceipt accepted_by_predecessor() {
    msg::KickReceipt out{};
    out.robot_id = 1;
    out.seq = 7;
    out.kick_id = 41;
    out.accepted = true;
    out.order_t_ns = 900'000'000;
    out.fired_t_ns = 919'000'000;
    out.release_t_ns = 979'000'000;
    return out;
  }
  /// Whether it becomes true while real time goes on and the nodes' time hardly does.
  bool eventually(const std::function<bool()>& true_now) {
    const auto deadline = std::chrono::steady_clock::now() + kPlenty;
    while (std::chrono::steady_clock::now() < deadline)
      if (true_now()) return true;
    return false;
  }
  msg::KickReceipt answer(const msg::KickOrder& wished) {
    order(wished);
    return receipt.nth(++orders);
  }

  std::int64_t t_ns = 1'000'000'000;
  std::size_t samples = 0;
  std::size_t orders = 0;
  Received<msg::KickerStatus> status{participant};
  Received<msg::KickReceipt> receipt{participant};
  Says<msg::KickOrder> order{participant, 1, "kick_decision/1"};
  Says<msg::DriveCommand> drive{participant, 1, "kick_decision/1"};
  std::optional<Says<msg::Referee>> referee{std::in_place, participant};
  std::optional<KickerDriverNode> node;
  std::optional<Running> running;
};

TEST_F(KickerDriverNodeTest, SaysOnceThatItsBoardIsEmulated) {
  Received<msg::DeviceEmulated> emulated{participant};
  start();
  sample();
  EXPECT_TRUE(emulated.now().empty());
  for (int i = 0; i < 2; ++i) {
    clock_ns = t_ns += 20'000'000;
    kicker->put({.t_ns = t_ns, .charge = 1.0, .armed = true, .emulated = true});
    status.nth(++samples);
  }
  ASSERT_EQ(emulated.first(1).size(), 1u);
  EXPECT_EQ(emulated.nth(1).part, msg::PART_KICKER);
  EXPECT_EQ(emulated.nth(1).t_ns, t_ns - 20'000'000);
}

TEST_F(KickerDriverNodeTest, SaysHowTheKickerIs) {
  start();
  auto is = sample();
  EXPECT_EQ(is.robot_id, 1);
  EXPECT_EQ(is.seq, 1u);
  EXPECT_EQ(is.t_ns, t_ns);
  EXPECT_EQ(is.charge, 1.0);
  EXPECT_FALSE(is.armed || is.ready) << "no referee has spoken";
  play();
  is = sample(0.4);
  EXPECT_TRUE(is.armed);
  EXPECT_FALSE(is.ready);
  EXPECT_EQ(is.charge, 0.4);
  EXPECT_TRUE(sample().ready);
  is = sample(1.0, true, hal::KickerFault::kCoil);
  EXPECT_EQ(is.fault, msg::FAULT_COIL);
  EXPECT_FALSE(is.ready);
  EXPECT_FALSE(sample(1.0, false).armed);
  play(false);
  EXPECT_FALSE(sample().armed);
}

TEST_F(KickerDriverNodeTest, LogsWhatTheDeviceSaysOfItsLinkWheneverThatIsSomethingElse) {
  start();
  kicker->say_link("/dev/ttyUSB0: the line is cut");
  sample();
  EXPECT_TRUE(log_lines->wait_for("/dev/ttyUSB0: the line is cut"));
  kicker->say_link("/dev/ttyUSB0: ioBoard version 00000003");
  sample();
  EXPECT_TRUE(log_lines->wait_for("ioBoard version 00000003"));
}

TEST_F(KickerDriverNodeTest, FiresAnOrderAndAnswersIt) {
  for (const auto kind : {Executor::kListener, Executor::kWaitset}) {
    SCOPED_TRACE(kind);
    bus::Stop own_stop;
    NodeContext own{context.settings, context.robot, participant, context.logger, own_stop};
    own.steady_ns = context.steady_ns;
    const auto far_side = std::make_shared<KickerFarSide>();
    long_ago();
    KickerDriverNode own_node{own, std::make_unique<FakeKicker>(far_side)};
    clock_ns = t_ns;
    const Running own_run{kind, own_stop, {&own_node.node()}};
    order.expect_reader();
    play();
    // In kWaitset the word and the sample are heard by two threads, either first.
    EXPECT_TRUE(eventually([&] {
      far_side->put({t_ns, 1.0, true, hal::KickerFault::kNone});
      return status.nth(++samples).ready;
    }));
    const auto given = answer(wish(42, 33.5));
    EXPECT_TRUE(given.accepted);
    EXPECT_EQ(given.refusal, msg::REFUSAL_NONE);
    EXPECT_EQ(given.kick_id, 42);
    EXPECT_EQ(given.order_t_ns, t_ns);
    EXPECT_EQ(given.power, 33.5);
    EXPECT_GE(given.fired_t_ns, t_ns);
    EXPECT_EQ(given.fired_t_ns, given.t_ns);
    EXPECT_EQ(given.received_steady_ns, clock_ns);
    EXPECT_EQ(given.fired_steady_ns, clock_ns);
    EXPECT_EQ(given.release_t_ns - given.fired_t_ns, 60'000'000);
    const auto fired = far_side->commands(1);
    ASSERT_EQ(fired.size(), 1u);
    EXPECT_EQ(fired[0].kick_id, 42);
    EXPECT_EQ(fired[0].power, 33.5);
    EXPECT_EQ(fired[0].t_ns, given.fired_t_ns);
  }
}

TEST_F(KickerDriverNodeTest, RefusesWithTheReasonAndFiresNothing) {
  start();
  EXPECT_EQ(answer(wish(1)).refusal, msg::REFUSAL_UNARMED) << "before the first sample";
  sample();
  EXPECT_EQ(answer(wish(2)).refusal, msg::REFUSAL_UNARMED) << "before the referee's word";
  play();
  sample();
  EXPECT_EQ(answer(wish(3, 14.0)).refusal, msg::REFUSAL_OUT_OF_RANGE);
  EXPECT_EQ(answer(wish(4, std::numeric_limits<double>::quiet_NaN())).refusal, msg::REFUSAL_OUT_OF_RANGE);
  auto stale = wish(5);
  stale.valid_until_t_ns = t_ns - 1;
  EXPECT_EQ(answer(stale).refusal, msg::REFUSAL_STALE);
  auto early = wish(6);
  early.t_ns = early.fire_t_ns = t_ns + 3600'000'000'000;
  EXPECT_EQ(answer(early).refusal, msg::REFUSAL_STALE);
  EXPECT_EQ(answer(early).refusal, msg::REFUSAL_STALE);
  sample(0.5);
  EXPECT_EQ(answer(wish(7)).refusal, msg::REFUSAL_CHARGING);
  sample(1.0, true, hal::KickerFault::kCharger);
  EXPECT_EQ(answer(wish(8)).refusal, msg::REFUSAL_FAULT);
  const auto last = answer(wish(9));
  EXPECT_FALSE(last.accepted);
  EXPECT_EQ(last.fired_t_ns, 0);
  EXPECT_EQ(last.release_t_ns, 0);
  EXPECT_EQ(last.received_steady_ns, clock_ns);
  EXPECT_EQ(last.fired_steady_ns, 0);
  EXPECT_EQ(last.power, 0.0);
  EXPECT_EQ(last.seq, 10u);
  EXPECT_TRUE(log_lines->wait_for("kick 7 refused: charging"));
  EXPECT_EQ(kicker->commanded(), 0u);
  const auto is = sample();
  EXPECT_EQ(is.orders_handled, 10u);
  EXPECT_EQ(is.orders_refused, 10u);
  EXPECT_EQ(is.last_kick_id, 9);
  EXPECT_FALSE(is.last_accepted);
  EXPECT_TRUE(answer(wish(10)).accepted) << "after all that it still kicks";
}

TEST_F(KickerDriverNodeTest, AStopBeforeTheInstantOfAnAcceptedOrderCallsTheKickOff) {
  context.settings.run.cycle_s = 3600.0;  // a cycle as long as the test may take
  context.settings.kicker_driver.future_tolerance_s = 3600.0;
  start();
  play();
  sample();
  auto later = wish(5);
  later.fire_t_ns += 1800'000'000'000;
  later.valid_until_t_ns = later.fire_t_ns;
  const auto accepted = answer(later);
  EXPECT_TRUE(accepted.accepted);
  EXPECT_EQ(accepted.fired_t_ns, later.fire_t_ns);
  EXPECT_EQ(accepted.release_t_ns - accepted.fired_t_ns, 60'000'000);
  EXPECT_EQ(kicker->commands(1)[0].t_ns, later.fire_t_ns) << "the device has it and waits";
  play(false);
  const auto off = receipt.nth(++orders);
  EXPECT_EQ(off.kick_id, 5);
  EXPECT_FALSE(off.accepted);
  EXPECT_EQ(off.refusal, msg::REFUSAL_UNARMED);
  EXPECT_EQ(kicker->withdrawn, 5);
  EXPECT_FALSE(sample().last_accepted);
}

TEST_F(KickerDriverNodeTest, FiresNothingWhileTheWorldSaysThatTheGameStandsThoughTheRefereeWasNotHeardToStopIt) {
  context.settings.run.cycle_s = 3600.0;  // a cycle as long as the test may take
  context.settings.kicker_driver.future_tolerance_s = 3600.0;
  Says<msg::WorldState> world{participant};
  start();
  play();
  const auto says = [&](bool playing) {
    return [&world, playing, this] {
      msg::WorldState state{};
      state.t_ns = t_ns;
      state.playing = playing;
      world(state);
      return sample().armed == playing;
    };
  };
  ASSERT_TRUE(eventually(says(true)));
  auto later = wish(5);
  later.fire_t_ns += 1800'000'000'000;
  later.valid_until_t_ns = later.fire_t_ns;
  EXPECT_TRUE(answer(later).accepted);
  ASSERT_TRUE(eventually(says(false)));
  EXPECT_EQ(receipt.nth(++orders).refusal, msg::REFUSAL_UNARMED);
  EXPECT_EQ(kicker->withdrawn, 5) << "it was called off";
  EXPECT_EQ(answer(wish(6)).refusal, msg::REFUSAL_UNARMED);
  EXPECT_TRUE(eventually(says(true))) << "he had not stopped it, or lets play again";
}

TEST_F(KickerDriverNodeTest, ADriverThatBeginsRestsAsIfOneBeforeItHadAKickStillToGo) {
  node.emplace(context, fake_kicker());
  const std::int64_t began_ns = t_ns, cycle_ns = 20'000'000, interval_ns = 500'000'000;
  running.emplace(Executor::kListener, stop, std::vector<bus::Node*>{&node->node()});
  order.expect_reader();
  play();
  ASSERT_TRUE(eventually([&] { return sample(1.0, true, hal::KickerFault::kNone, 1'000).armed; }));
  EXPECT_EQ(answer(wish(1)).refusal, msg::REFUSAL_DOUBLE);
  sample(1.0, true, hal::KickerFault::kNone, began_ns + cycle_ns + interval_ns - 1 - t_ns);
  play();
  ASSERT_TRUE(eventually([&] { return sample(1.0, true, hal::KickerFault::kNone, 0).state != msg::STATE_OFF; }))
      << "the drive command was heard";
  EXPECT_EQ(answer(wish(2)).refusal, msg::REFUSAL_DOUBLE);
  sample(1.0, true, hal::KickerFault::kNone, 1);
  EXPECT_TRUE(answer(wish(3)).accepted);
}

TEST_F(KickerDriverNodeTest, AnOrderSentTwiceIsFiredOnce) {
  start();
  play();
  sample();
  EXPECT_TRUE(answer(wish(1)).accepted);
  EXPECT_EQ(answer(wish(1)).refusal, msg::REFUSAL_DOUBLE);
  EXPECT_EQ(answer(wish(2)).refusal, msg::REFUSAL_DOUBLE) << "too soon";
  EXPECT_EQ(kicker->commanded(), 1u);
  EXPECT_FALSE(sample().ready);
}

TEST_F(KickerDriverNodeTest, ASilentDeviceIsAFault) {
  start();
  play();
  sample();
  clock_ns += 100'000'001;  // link_timeout_s 0.1
  EXPECT_EQ(answer(wish(1)).refusal, msg::REFUSAL_FAULT);
}

// As after a stall of the process: everything that came meanwhile is there at once, and time has gone on.
TEST_F(KickerDriverNodeTest, WhatWaitedWhileItStoodStillIsNotFired) {
  start();
  play();
  sample();
  auto waiting = wish(1);
  waiting.valid_until_t_ns = t_ns + 3600'000'000'000;
  clock_ns += 1'000'000'000;
  kicker->put({t_ns += 20'000'000, 1.0, true, hal::KickerFault::kNone});  // of the backlog
  EXPECT_FALSE(status.nth(++samples).ready) << "a sample is as old as it is";
  EXPECT_EQ(answer(waiting).refusal, msg::REFUSAL_FAULT);
  t_ns = clock_ns;
  play();
  sample();
  waiting.kick_id = 2;
  EXPECT_EQ(answer(waiting).refusal, msg::REFUSAL_STALE);
  EXPECT_EQ(kicker->commanded(), 0u);
  EXPECT_TRUE(answer(wish(3)).accepted);
}

TEST_F(KickerDriverNodeTest, SamplesOfAnotherClockAreSaid) {
  start();
  play();
  clock_ns = 5'000'000'000'000;
  kicker->put({20'000'000, 1.0, true, hal::KickerFault::kNone});
  EXPECT_FALSE(status.nth(++samples).ready);
  EXPECT_TRUE(log_lines->wait_for("off this machine's steady clock"));
}

TEST_F(KickerDriverNodeTest, ASilentRefereeDisarmsAndHisWordArmsAgain) {
  start();
  play();
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(sample().armed);
  EXPECT_FALSE(sample().armed) << "run.referee_timeout_s 1 is over";
  EXPECT_TRUE(log_lines->wait_for("the referee is silent"));
  const auto refused = answer(wish(1));
  EXPECT_EQ(refused.refusal, msg::REFUSAL_REFEREE_SILENT);
  EXPECT_EQ(kicker->commanded(), 0u);
  play();
  EXPECT_TRUE(sample().armed);
  EXPECT_TRUE(log_lines->wait_for("the referee is received again"));
  EXPECT_TRUE(answer(wish(2)).accepted);
}

TEST_F(KickerDriverNodeTest, BetweenTwoSamplesSilenceCountsToo) {
  context.settings.kicker_driver.link_timeout_s = 10.0;
  start();
  play();
  sample();
  clock_ns = t_ns += 1'000'000'000;
  EXPECT_EQ(answer(wish(1)).refusal, msg::REFUSAL_REFEREE_SILENT);
}

TEST_F(KickerDriverNodeTest, ARefereeWhoIsGoneDisarms) {
  start();
  play();
  EXPECT_TRUE(sample().armed);
  referee.reset();
  EXPECT_TRUE(eventually([&] { return !sample(1.0, true, hal::KickerFault::kNone, 1).armed; }))
      << "his writer was deleted";
  EXPECT_EQ(answer(wish(1)).refusal, msg::REFUSAL_REFEREE_SILENT);
  referee.emplace(participant);
  play();
  EXPECT_TRUE(eventually([&] { return sample(1.0, true, hal::KickerFault::kNone, 1).armed; }));
}

TEST_F(KickerDriverNodeTest, AnotherRobotsOrdersAreNotItsOwn) {
  Says<msg::KickOrder> other{participant, 2, "kick_decision/2"};
  start();
  other.expect_reader();
  play();
  sample();
  other(wish(1));
  EXPECT_EQ(answer(wish(2)).kick_id, 2);
  EXPECT_EQ(kicker->commanded(), 1u);
}

TEST_F(KickerDriverNodeTest, ASecondDecisionNodeIsUnauthorisedOnARobotThatHasOne) {
  Says<msg::KickOrder> second{participant, 1, "kick_decision_second/1"};
  start();
  second.expect_reader();
  play();
  sample();
  second(wish(1));
  EXPECT_EQ(receipt.nth(1).refusal, msg::REFUSAL_UNAUTHORISED);
  EXPECT_EQ(kicker->commanded(), 0u);
}

TEST_F(KickerDriverNodeTest, ASecondDecisionNodeIsHeardByARobotThatIsConfiguredForTwo) {
  context.settings.kick_decision.standby = true;
  Says<msg::KickOrder> second{participant, 1, "kick_decision_second/1"};
  start();
  second.expect_reader();
  play();
  sample();
  second(wish(1));
  EXPECT_EQ(receipt.nth(1).refusal, msg::REFUSAL_NONE);
  EXPECT_EQ(kicker->commanded(), 1u);
}

TEST_F(KickerDriverNodeTest, LeavesTheKickerSafe) {
  start();
  play();
  sample();
  EXPECT_FALSE(kicker->safe);
  running.reset();
  node.reset();
  EXPECT_TRUE(kicker->safe);
}

TEST_F(NodeTest, TheKickerDriverSaysWhenTheDecisionLoopFallsSilent) {
  KickerDriverNode node{context, fake_kicker()};
  const Running running{Executor::kListener, stop, {&node.node()}};
  bus::Writer<msg::KickOrder> loop{
      participant, {.period = {}, .lease = std::chrono::milliseconds{20}, .strength = 0, .owner = "kick_decision/1"}};
  ASSERT_TRUE(loop.wait_for_readers(1, kPlenty));
  // Alive for longer than a writer is by its birth alone, or back from a lapse; and never again.
  clock_ns += 400'000'000;
  loop.assert_liveliness();
  EXPECT_TRUE(log_lines->wait_for("the decision loop is silent"));
}

TEST_F(KickerDriverNodeTest, AShotThatTheDeviceWasNotToldOfIsNoKick) {
  using What = hal::ShotResult::What;
  start();
  sample();
  play();
  sample();
  std::int64_t kick_id = 4;
  for (const auto& [what, refusal] :
       std::vector<std::pair<What, msg::Refusal>>{{What::kLate, msg::REFUSAL_STALE},
                                                  {What::kCalledOff, msg::REFUSAL_UNARMED},
                                                  {What::kDevice, msg::REFUSAL_FAULT}}) {
    ASSERT_TRUE(answer(wish(++kick_id)).accepted);
    kicker->say_result({kick_id, what, t_ns});
    sample(1.0, true, hal::KickerFault::kNone, 60'000'000);
    const msg::KickReceipt second = receipt.nth(++orders);
    EXPECT_EQ(second.kick_id, kick_id);
    EXPECT_FALSE(second.accepted);
    EXPECT_EQ(second.refusal, refusal);
    play();
    sample();
  }
}

TEST_F(KickerDriverNodeTest, TheShotEndsWithTheOrderOrWithTheRefereesWord) {
  start();
  sample();
  play();
  sample();
  const msg::KickOrder wished = wish(5);
  ASSERT_TRUE(answer(wished).accepted);
  EXPECT_EQ(kicker->commands(1).at(0).until_ns, wished.valid_until_t_ns);
}

TEST_F(KickerDriverNodeTest, TheNextKickRestsFromTheRealPulse) {
  start();
  sample();
  play();
  sample();
  ASSERT_TRUE(answer(wish(5)).accepted);
  kicker->say_result({5, hal::ShotResult::What::kFired, t_ns + 40'000'000});
  sample(1.0, true, hal::KickerFault::kNone, 60'000'000);
  play();
  sample(1.0, true, hal::KickerFault::kNone, 450'000'000);  // 0.51 s after the order, 0.47 s after the pulse
  play();
  EXPECT_EQ(answer(wish(6)).refusal, msg::REFUSAL_DOUBLE);
}

TEST_F(KickerDriverNodeTest, AStopCallsOffWhateverTheGateKnows) {
  start();
  sample();
  play();
  EXPECT_FALSE(kicker->holds(t_ns));
  play(false);
  EXPECT_TRUE(eventually([&] { return kicker->holds(t_ns); }));
  EXPECT_FALSE(kicker->holds(t_ns + 1)) << "what is judged afterwards";
}

TEST_F(KickerDriverNodeTest, NothingIsFiredAfterTheStopAndWhatWasPendingGetsItsReceipt) {
  context.settings.run.cycle_s = 3600.0;  // a cycle as long as the test may take
  context.settings.kicker_driver.future_tolerance_s = 3600.0;
  start();
  sample();
  play();
  sample();
  auto later = wish(5);
  later.fire_t_ns += 1800'000'000'000;
  later.valid_until_t_ns = later.fire_t_ns;
  ASSERT_TRUE(answer(later).accepted);
  stop.request();
  EXPECT_TRUE(kicker->holds(t_ns + 1));
  const auto off = receipt.nth(++orders);
  EXPECT_FALSE(off.accepted);
  EXPECT_EQ(off.kick_id, 5);
  EXPECT_EQ(kicker->withdrawn, 5);
}

TEST_F(KickerDriverNodeTest, ASecondWriterOfTheRefereeCannotLetPlayWhereTheFirstStops) {
  Says<msg::Referee> forger{participant};
  start();
  sample();
  play();
  play(false);
  ASSERT_FALSE(sample().armed);
  const auto forged = [&] {
    msg::Referee word{};
    word.t_ns = t_ns;
    word.playing = true;
    forger(word);
    return sample().armed;
  };
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(forged()) << i;
  EXPECT_EQ(answer(wish(5)).refusal, msg::REFUSAL_UNARMED);
}

TEST_F(KickerDriverNodeTest, WhereTwoProgramsDriveInTheDecisionNodesNameNothingIsFired) {
  const bus::Participant elsewhere{domain};
  Says<msg::DriveCommand> forged_drive{elsewhere, 1, "kick_decision/1"};
  start();
  sample();
  play();
  sample();
  const auto both_drive = [&] {
    forged_drive({});
    drive({});
    return sample(1.0, true, hal::KickerFault::kNone, 1'000).state == msg::STATE_OFF;
  };
  EXPECT_TRUE(eventually(both_drive));
}

TEST_F(KickerDriverNodeTest, WhatAKilledDriverAcceptedAndNeverToldTheDeviceGetsAReceiptOfItsSuccessor) {
  const std::string name = PendingKick::name_of(context.settings.domain, 1);
  PendingKick{name}.accepted(accepted_by_predecessor());  // and there it was killed
  start();
  sample();
  const auto left = receipt.nth(++orders);
  EXPECT_EQ(left.kick_id, 41);
  EXPECT_EQ(left.order_t_ns, 900'000'000);
  EXPECT_FALSE(left.accepted);
  EXPECT_EQ(left.refusal, msg::REFUSAL_FAULT);
  play();
  sample();
  ASSERT_TRUE(answer(wish(42)).accepted);
  EXPECT_FALSE(PendingKick{name}.left()) << "the device was told";
}

TEST_F(KickerDriverNodeTest, WhereADriverWasKilledWhileItToldTheDeviceTheKickCountsAndItsReceiptSaysNotKnown) {
  const std::string name = PendingKick::name_of(context.settings.domain, 1);
  {
    PendingKick predecessor{name};
    predecessor.accepted(accepted_by_predecessor());
    predecessor.being_told();  // and there it was killed
  }
  start();
  sample();
  const auto left = receipt.nth(++orders);
  EXPECT_EQ(left.kick_id, 41);
  EXPECT_TRUE(left.accepted);
  EXPECT_EQ(left.refusal, msg::REFUSAL_NOT_KNOWN);
  EXPECT_EQ(left.fired_t_ns, 919'000'000);
  EXPECT_EQ(left.release_t_ns, 979'000'000);
  EXPECT_FALSE(msg::begins_kick(left)) << "nobody starts anything by it";
}

TEST_F(KickerDriverNodeTest, MemoryThatHoldsNoKickGivesNoReceipt) {
  const std::string name = PendingKick::name_of(context.settings.domain, 1);
  msg::KickReceipt none{};
  PendingKick{name}.accepted(none);
  EXPECT_FALSE(PendingKick{name}.left());
  PendingKick{name}.settled();
}

TEST_F(KickerDriverNodeTest, AnOrderAloneIsNoSignThatTheDecisionNodeLives) {
  start();
  sample();
  msg::Referee word{};
  word.t_ns = t_ns;
  word.playing = true;
  (*referee)(word);
  sample();
  EXPECT_EQ(answer(wish(5)).refusal, msg::REFUSAL_UNARMED) << "no drive command was heard";
  play();
  sample();
  EXPECT_TRUE(answer(wish(6)).accepted);
  sample(1.0, true, hal::KickerFault::kNone, 700'000'000);
  (*referee)([&] {
    word.t_ns = t_ns;
    return word;
  }());
  sample();
  EXPECT_EQ(answer(wish(7)).refusal, msg::REFUSAL_UNARMED) << "the last one is 0.7 s ago";
}

TEST_F(KickerDriverNodeTest, ASetPointBeyondThePulseEndsItAtItsStart) {
  long_ago();
  kicker->most_power = context.robot.model.table.back().power - 1.0;
  EXPECT_THROW(node.emplace(context, fake_kicker()), std::runtime_error);
}

}  // namespace
}  // namespace trivela::nodes
