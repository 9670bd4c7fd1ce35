#include "robot/driver/order_gate.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

constexpr std::int64_t kNow_ns = 10'000 * kMs;
constexpr double kCycle_s = 0.02;
constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
constexpr auto kMost = std::numeric_limits<std::int64_t>::max();

msg::KickOrder order_at(std::int64_t t_ns, std::int64_t kick_id = 1) {
  msg::KickOrder order{};
  order.robot_id = 1;
  order.t_ns = order.fire_t_ns = t_ns;
  order.valid_until_t_ns = t_ns + 50 * kMs;
  order.kick_id = kick_id;
  order.power = 25.0;
  order.possession = true;
  return order;
}

// A gate that would let an order at kNow_ns pass, with one thing after the other taken away by the tests.
struct Case {
  config::KickerDriver settings{};
  hal::KickerSample sample{kNow_ns, 1.0, true, hal::KickerFault::kNone};
  bool received = true;
  RefereePermission referee = RefereePermission::kPlay;
  std::vector<msg::KickOrder> before{};
  msg::KickOrder order = order_at(kNow_ns);
  std::int64_t now_ns = kNow_ns;
  std::vector<kicking::Range> powers{{15.0, 50.0}};

  OrderGate gate() const {
    OrderGate gate{settings, powers, kCycle_s};
    if (!before.empty()) {  // answered while everything was well
      for (const auto& past : before) {
        gate.device({past.t_ns, 1.0, true, hal::KickerFault::kNone});
        gate.referee(RefereePermission::kPlay);
        gate.judge(past, past.t_ns, OrderBy::kOwnDecision);
      }
    }
    if (received) gate.device(sample);
    gate.referee(referee);
    return gate;
  }
  msg::Refusal answer() const { return gate().judge(order, now_ns, OrderBy::kOwnDecision); }
};

/// The first cells of the table below `heading`, in its order, without the head.
std::vector<std::string> first_cells(const std::string& file, const std::string& heading) {
  std::ifstream in(file);
  std::vector<std::string> cells;
  bool below = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## ")) below = line == heading;
    if (!below || !line.starts_with("| ") || line.starts_with("| refusal")) continue;
    cells.push_back(line.substr(2, line.find(" |", 2) - 2));
  }
  return cells;
}

TEST(OrderGate, RefusesInTheOrderOfTheTableInTheDocuments) {
  Case c;  // everything is wrong with it; each step mends what was refused
  c.powers = {{15.0, 50.0}, {15.0, 50.0}};
  c.sample = {kNow_ns - 10'000 * kMs, 0.0, false, hal::KickerFault::kCoil};
  c.referee = RefereePermission::kSilent;
  c.before = {order_at(kNow_ns - 5'000 * kMs, 7)};
  c.order = order_at(kNow_ns - 5'000 * kMs, 0);
  c.order.possession = false;
  c.order.power = 500.0;
  auto by = OrderBy::kUnauthorised;
  const std::vector<std::pair<msg::Refusal, std::pair<std::string, std::function<void()>>>> steps{
      {msg::REFUSAL_UNAUTHORISED, {"unauthorised", [&] { by = OrderBy::kOwnDecision; }}},
      {msg::REFUSAL_FAULT,
       {"fault",
        [&] {
          c.sample = {kNow_ns, 0.0, false, hal::KickerFault::kNone};
        }}},
      {msg::REFUSAL_OUT_OF_RANGE,
       {"out_of_range",
        [&] {
          c.order.power = 25.0;
          c.order.kick_id = 7;
        }}},
      {msg::REFUSAL_NO_BALL, {"no_ball", [&] { c.order.possession = true; }}},
      {msg::REFUSAL_UNARMED, {"unarmed", [&] { c.sample.armed = true; }}},
      {msg::REFUSAL_REFEREE_SILENT, {"referee_silent", [&] { c.referee = RefereePermission::kPlay; }}},
      {msg::REFUSAL_STALE, {"stale", [&] { c.order = order_at(kNow_ns, 7); }}},
      {msg::REFUSAL_DOUBLE, {"double", [&] { c.order.kick_id = 8; }}},
      {msg::REFUSAL_CHARGING,
       {"charging",
        [&] {
          c.sample.charge = 1.0;
          c.sample.lever_kind = kicking::kLeverMoves;
        }}},
      {msg::REFUSAL_LEVER, {"lever", [&] { c.sample.lever_kind = 0; }}}};
  std::vector<std::string> names;
  for (const auto& [refusal, step] : steps) {
    EXPECT_EQ(c.gate().judge(c.order, c.now_ns, by), refusal) << step.first;
    names.push_back(step.first);
    step.second();
  }
  EXPECT_EQ(c.gate().judge(c.order, c.now_ns, by), msg::REFUSAL_NONE);
  EXPECT_EQ(names, first_cells(TRIVELA_SOURCE_DIR "/docs/operations.md", "## The conditions of an order"));
}

TEST(OrderGate, LetsAnOrderPassWhenEverythingIsWell) {
  Case c;
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE);
  for (const double power : {15.0, 50.0}) {
    c.order.power = power;
    EXPECT_EQ(c.answer(), msg::REFUSAL_NONE) << power;
  }
  c.order = order_at(kNow_ns - 50 * kMs);
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE) << "valid to the last instant";
  c.order = order_at(kNow_ns + 5 * kMs);
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE) << "clocks differ a little";
}

TEST(OrderGate, RefusesAKindOfKickForWhichTheLeverDoesNotStand) {
  Case c;
  c.powers = {{15.0, 50.0}, {20.0, 60.0}};
  c.order.kick_kind = 1;
  EXPECT_EQ(c.answer(), msg::REFUSAL_LEVER);
  c.sample.lever_kind = kicking::kLeverMoves;
  EXPECT_EQ(c.answer(), msg::REFUSAL_LEVER);
  c.sample.lever_kind = 1;
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE);
  c.order.power = 55.0;
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE) << "each kind has set-points of its own";
  c.order.power = 15.0;
  EXPECT_EQ(c.answer(), msg::REFUSAL_OUT_OF_RANGE);
  c.order.kick_kind = 2;
  EXPECT_EQ(c.answer(), msg::REFUSAL_OUT_OF_RANGE) << "the robot has no such kind";
}

TEST(OrderGate, OfOneKindDoesNotAskForTheLever) {
  Case c;
  c.sample.lever_kind = kicking::kLeverMoves;
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE);
}

TEST(OrderGate, RefusesAnOrderThatWasGivenWithoutTheBall) {
  Case c;
  c.order.possession = false;
  EXPECT_EQ(c.answer(), msg::REFUSAL_NO_BALL);
  OrderGate gate = c.gate();
  EXPECT_EQ(gate.judge(c.order, kNow_ns, OrderBy::kOwnDecision), msg::REFUSAL_NO_BALL);
  c.order.possession = true;
  EXPECT_EQ(gate.judge(c.order, kNow_ns, OrderBy::kOwnDecision), msg::REFUSAL_NONE)
      << "a refused order keeps nobody's id";
}

TEST(OrderGate, RefusesAnUnauthorisedOrderWhateverItSays) {
  Case c;
  OrderGate gate = c.gate();
  EXPECT_EQ(gate.judge(c.order, kNow_ns, OrderBy::kUnauthorised), msg::REFUSAL_UNAUTHORISED);
  EXPECT_EQ(gate.handled(), 1u);
  EXPECT_EQ(gate.refused(), 1u);
  EXPECT_EQ(gate.last_kick_id(), 0) << "the decision node hears of its own alone";
  EXPECT_EQ(gate.judge(c.order, kNow_ns, OrderBy::kOwnDecision), msg::REFUSAL_NONE) << "a copy of it makes no double";
  gate = c.gate();
  EXPECT_EQ(gate.judge(order_at(kNow_ns, 2), kNow_ns, OrderBy::kOwnDecision), msg::REFUSAL_NONE)
      << "the robot's own goes on";
  c.sample.fault = hal::KickerFault::kCoil;
  EXPECT_EQ(c.gate().judge(c.order, kNow_ns, OrderBy::kUnauthorised), msg::REFUSAL_UNAUTHORISED)
      << "nobody else is told why";
}

TEST(OrderGate, RefusesAStaleOrder) {
  Case c;
  c.order = order_at(kNow_ns - 50 * kMs - 1);
  EXPECT_EQ(c.answer(), msg::REFUSAL_STALE);
  c.order = order_at(kNow_ns);
  c.order.valid_until_t_ns = kLeast;
  EXPECT_EQ(c.answer(), msg::REFUSAL_STALE);
}

TEST(OrderGate, RefusesAnOldOrderWhateverItSaysOfItsValidity) {
  Case c;
  for (const std::int64_t t_ns : {std::int64_t{0}, kLeast, kLeast + 1, kNow_ns - 101 * kMs, -kNow_ns}) {
    c.order.t_ns = t_ns;
    for (const std::int64_t fire_t_ns : {t_ns, kNow_ns}) {
      c.order.fire_t_ns = fire_t_ns;
      for (const std::int64_t valid : {kNow_ns, kNow_ns + 3'600'000 * kMs, kMost}) {
        c.order.valid_until_t_ns = valid;
        EXPECT_EQ(c.answer(), msg::REFUSAL_STALE) << t_ns;
      }
    }
  }
  c.order.t_ns = c.order.fire_t_ns = kNow_ns - 100 * kMs;
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE) << "max_order_age_s";
}

TEST(OrderGate, ARefereeWhoFellSilentIsAReasonOfItsOwn) {
  Case c;
  c.referee = RefereePermission::kSilent;
  EXPECT_EQ(c.answer(), msg::REFUSAL_REFEREE_SILENT);
  c.sample.armed = false;
  EXPECT_EQ(c.answer(), msg::REFUSAL_UNARMED) << "the switch is nearer";
  c = {};
  c.referee = RefereePermission::kNothing;
  EXPECT_EQ(c.answer(), msg::REFUSAL_UNARMED);
}

TEST(OrderGate, ASampleFromTheFutureIsNoneOfThisClock) {
  Case c;
  c.sample.t_ns = kNow_ns + 25 * kMs;
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE);
  c.sample.t_ns += kMs;
  EXPECT_EQ(c.answer(), msg::REFUSAL_FAULT);
}

TEST(OrderGate, RefusesAnOrderFromTheFuture) {
  Case c;
  for (const std::int64_t t_ns : {kNow_ns + 26 * kMs, kNow_ns + 1000 * kMs, kMost}) {
    c.order = order_at(kNow_ns);
    c.order.valid_until_t_ns = kMost;
    c.order.t_ns = t_ns;
    EXPECT_EQ(c.answer(), msg::REFUSAL_STALE) << t_ns;
    c.order.t_ns = kNow_ns;
    c.order.fire_t_ns = t_ns;  // the game that was judged would be over by then
    EXPECT_EQ(c.answer(), msg::REFUSAL_STALE) << "to be fired at " << t_ns;
  }
}

TEST(OrderGate, LetsAnOrderBeFiredWithinTheCycleThatItWasJudgedFor) {
  for (const std::int64_t after_ms : {0, 1, 13, 20}) {
    Case c;
    c.order.fire_t_ns = c.order.t_ns + after_ms * kMs;
    EXPECT_EQ(c.answer(), msg::REFUSAL_NONE) << after_ms;
  }
  for (const std::int64_t after_ns : {-kMs, std::int64_t{-1}, 20 * kMs + 2, 24 * kMs}) {
    Case c;
    c.order.fire_t_ns = c.order.t_ns + after_ns;
    EXPECT_EQ(c.answer(), msg::REFUSAL_STALE) << after_ns;
  }
}

TEST(OrderGate, CountsTheIntervalFromTheInstantOfTheKick) {
  Case c;
  auto later = order_at(kNow_ns - 500 * kMs, 1);
  later.fire_t_ns += 10 * kMs;
  c.before = {later};
  c.order.kick_id = 2;
  EXPECT_EQ(c.answer(), msg::REFUSAL_DOUBLE);
  c.now_ns += 10 * kMs;
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE);
}

TEST(OrderGate, CountsTheIntervalFromAKickThatOneBeforeItMayHaveHad) {
  Case c;
  OrderGate gate = c.gate();
  gate.rest_from(kNow_ns - 499 * kMs);
  EXPECT_FALSE(gate.rested(kNow_ns));
  EXPECT_EQ(gate.judge(order_at(kNow_ns, 1), kNow_ns, OrderBy::kOwnDecision), msg::REFUSAL_DOUBLE);
  gate.rest_from(kNow_ns - 500 * kMs);
  EXPECT_EQ(gate.judge(order_at(kNow_ns, 2), kNow_ns, OrderBy::kOwnDecision), msg::REFUSAL_NONE);
}

// An accepted order that is to be fired 15 ms later, looked at after `passed_ms` with one thing taken away.
std::optional<OrderGate::Withdrawal> withdrawn_after(std::int64_t passed_ms,
                                                     const std::function<void(OrderGate&)>& change) {
  OrderGate gate = Case{}.gate();
  auto later = order_at(kNow_ns, 7);
  later.fire_t_ns += 15 * kMs;
  EXPECT_EQ(gate.judge(later, kNow_ns, OrderBy::kOwnDecision), msg::REFUSAL_NONE);
  change(gate);
  const auto withdrawal = gate.withdraw(kNow_ns + passed_ms * kMs);
  EXPECT_FALSE(gate.withdraw(kNow_ns + passed_ms * kMs)) << "once";
  return withdrawal;
}

TEST(OrderGate, CallsAnOrderOffWhoseInstantLiesAheadWhenItHasBecomeUnsafe) {
  const auto stopped = [](OrderGate& gate) { gate.referee(RefereePermission::kStop); };
  const auto opened = [](OrderGate& gate) { gate.device({kNow_ns, 1.0, false, hal::KickerFault::kNone}); };
  const auto broken = [](OrderGate& gate) { gate.device({kNow_ns, 1.0, true, hal::KickerFault::kCoil}); };
  const auto well = [](OrderGate&) {};
  for (const auto& unsafe : {std::function<void(OrderGate&)>{stopped}, std::function<void(OrderGate&)>{opened}}) {
    const auto withdrawal = withdrawn_after(14, unsafe);
    ASSERT_TRUE(withdrawal);
    EXPECT_EQ(withdrawal->kick_id, 7);
    EXPECT_EQ(withdrawal->order_t_ns, kNow_ns);
    EXPECT_EQ(withdrawal->reason, msg::REFUSAL_UNARMED);
    EXPECT_FALSE(withdrawn_after(15, unsafe)) << "the coil is energised";
  }
  EXPECT_EQ(withdrawn_after(5, broken)->reason, msg::REFUSAL_FAULT);
  EXPECT_FALSE(withdrawn_after(5, well));
}

TEST(OrderGate, AnOrderThatWasCalledOffCountsAsRefusedAndDelaysNobody) {
  OrderGate gate = Case{}.gate();
  auto later = order_at(kNow_ns, 7);
  later.fire_t_ns += 15 * kMs;
  gate.judge(later, kNow_ns, OrderBy::kOwnDecision);
  gate.referee(RefereePermission::kStop);
  ASSERT_TRUE(gate.withdraw(kNow_ns + kMs));
  EXPECT_EQ(gate.handled(), 1u);
  EXPECT_EQ(gate.refused(), 1u);
  EXPECT_FALSE(gate.last_accepted());
  gate.referee(RefereePermission::kPlay);
  EXPECT_EQ(gate.judge(order_at(kNow_ns + 2 * kMs, 8), kNow_ns + 2 * kMs, OrderBy::kOwnDecision), msg::REFUSAL_NONE);
  EXPECT_EQ(gate.judge(order_at(kNow_ns + 3 * kMs, 7), kNow_ns + 3 * kMs, OrderBy::kOwnDecision), msg::REFUSAL_DOUBLE)
      << "it was answered";
}

TEST(OrderGate, SurvivesTimesFromTheEndsOfTheScale) {
  for (const std::int64_t t_ns : {kLeast, kLeast + 1, std::int64_t{0}, kMost}) {
    Case c;
    c.order.t_ns = c.order.fire_t_ns = c.order.valid_until_t_ns = t_ns;
    EXPECT_EQ(c.answer(), msg::REFUSAL_STALE) << t_ns;
  }
}

TEST(OrderGate, RefusesPowersThatAreNoSetPoint) {
  Case c;
  for (const double power : {std::nan(""), HUGE_VAL, -HUGE_VAL, 14.999, 50.001, 0.0, -25.0, 1e300}) {
    c.order.power = power;
    EXPECT_EQ(c.answer(), msg::REFUSAL_OUT_OF_RANGE) << power;
  }
}

TEST(OrderGate, RefusesWhileUnarmed) {
  Case by_switch;
  by_switch.sample.armed = false;
  EXPECT_EQ(by_switch.answer(), msg::REFUSAL_UNARMED);
  Case by_referee;
  by_referee.referee = RefereePermission::kStop;
  EXPECT_EQ(by_referee.answer(), msg::REFUSAL_UNARMED);
  Case before_the_first_sample;
  before_the_first_sample.received = false;
  EXPECT_EQ(before_the_first_sample.answer(), msg::REFUSAL_UNARMED);
}

TEST(OrderGate, RefusesAKickIdThatItHasAnswered) {
  Case c;
  c.before = {order_at(kNow_ns - 3000 * kMs, 1), order_at(kNow_ns - 2000 * kMs, 2), order_at(kNow_ns - 1000 * kMs, 3)};
  for (const std::int64_t id : {1, 2, 3}) {
    c.order = order_at(kNow_ns, id);
    EXPECT_EQ(c.answer(), msg::REFUSAL_DOUBLE) << id;
  }
  c.order = order_at(kNow_ns, 4);
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE);
}

TEST(OrderGate, ARefusedOrderKeepsNobodysKickIdButIsKnownAgainAsAWhole) {
  Case c;
  auto forged = order_at(kNow_ns - 20 * kMs, 8);
  forged.power = 99.0;
  auto early = order_at(kNow_ns - 20 * kMs, 8);
  early.valid_until_t_ns = kNow_ns - 30 * kMs;
  c.before = {forged, early};
  c.order = order_at(kNow_ns, 8);
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE) << "the true order of that kick";
  OrderGate gate = Case{}.gate();
  gate.device({kNow_ns, 0.1, true, hal::KickerFault::kNone});
  EXPECT_EQ(gate.judge(c.order, kNow_ns, OrderBy::kOwnDecision), msg::REFUSAL_CHARGING);
  gate.device({kNow_ns, 1.0, true, hal::KickerFault::kNone});
  EXPECT_EQ(gate.judge(c.order, kNow_ns, OrderBy::kOwnDecision), msg::REFUSAL_DOUBLE) << "the same order again";
}

TEST(OrderGate, NoFloodOfForgedOrdersMakesATrueOneDoubleOrAnOldOneNew) {
  OrderGate gate = Case{}.gate();
  EXPECT_EQ(gate.judge(order_at(kNow_ns, 1), kNow_ns, OrderBy::kOwnDecision), msg::REFUSAL_NONE);
  for (std::int64_t id = 1; id <= 1000; ++id) {
    auto forged = order_at(kNow_ns + id, id);
    forged.power = std::nan("");
    EXPECT_NE(gate.judge(forged, kNow_ns + id, OrderBy::kOwnDecision), msg::REFUSAL_NONE);
  }
  const std::int64_t later_ns = kNow_ns + 600 * kMs;
  gate.device({later_ns, 1.0, true, hal::KickerFault::kNone});
  EXPECT_EQ(gate.judge(order_at(later_ns, 1), later_ns, OrderBy::kOwnDecision), msg::REFUSAL_DOUBLE)
      << "accepted before the flood";
  EXPECT_EQ(gate.judge(order_at(later_ns, 2), later_ns, OrderBy::kOwnDecision), msg::REFUSAL_NONE);
}

TEST(OrderGate, RemembersAsManyKickIdsAsItSaysHoweverOftenOneIsRepeated) {
  Case c;
  for (std::int64_t id = 1; id <= static_cast<std::int64_t>(OrderGate::kRemembered); ++id) {
    c.before.push_back(order_at(kNow_ns - 100'000 * kMs + id * 1000 * kMs, id));
    c.before.push_back(c.before.back());  // a repetition takes no room
  }
  c.order = order_at(kNow_ns, 1);
  EXPECT_EQ(c.answer(), msg::REFUSAL_DOUBLE);
}

TEST(OrderGate, RefusesNumbersThatNoKickHas) {
  Case c;
  for (const std::int64_t id : {std::int64_t{0}, std::int64_t{-1}, kLeast}) {
    c.order.kick_id = id;
    EXPECT_EQ(c.answer(), msg::REFUSAL_OUT_OF_RANGE) << id;
  }
}

TEST(OrderGate, RefusesAKickTooSoonAfterTheLast) {
  Case c;
  c.before = {order_at(kNow_ns - 499 * kMs, 1)};
  c.order.kick_id = 2;
  EXPECT_EQ(c.answer(), msg::REFUSAL_DOUBLE);
  c.before = {order_at(kNow_ns - 500 * kMs, 1)};
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE);
}

TEST(OrderGate, ARefusedOrderDelaysNobody) {
  Case c;
  auto too_strong = order_at(kNow_ns - 20 * kMs, 1);
  too_strong.power = 99.0;
  c.before = {too_strong};
  c.order.kick_id = 2;
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE);
}

TEST(OrderGate, RefusesWhileCharging) {
  Case c;
  for (const double charge : {0.0, 0.899, std::nan(""), 1.06, 1e308}) {
    c.sample.charge = charge;
    EXPECT_EQ(c.answer(), msg::REFUSAL_CHARGING) << charge;
  }
  c.sample.charge = 0.9;
  EXPECT_EQ(c.answer(), msg::REFUSAL_NONE);
}

TEST(OrderGate, RefusesWithAFaultOfTheDeviceOrItsSilence) {
  for (const auto fault : {hal::KickerFault::kCharger, hal::KickerFault::kCoil, hal::KickerFault::kLink}) {
    Case c;
    c.sample.fault = fault;
    EXPECT_EQ(c.answer(), msg::REFUSAL_FAULT);
  }
  Case silent;
  silent.sample.t_ns = kNow_ns - 100 * kMs;
  EXPECT_EQ(silent.answer(), msg::REFUSAL_NONE);
  silent.sample.t_ns -= 1 * kMs;
  EXPECT_EQ(silent.answer(), msg::REFUSAL_FAULT);
}

// Each fault alone is answered with its reason; of two the earlier in this list.
TEST(OrderGate, NamesTheFirstReasonOfSeveral) {
  struct Wrong {
    msg::Refusal refusal;
    std::function<void(Case&)> make;
  };
  const std::vector<Wrong> in_order{
      {msg::REFUSAL_FAULT, [](Case& c) { c.sample.fault = hal::KickerFault::kCoil; }},
      {msg::REFUSAL_OUT_OF_RANGE, [](Case& c) { c.order.power = 99.0; }},
      {msg::REFUSAL_UNARMED, [](Case& c) { c.referee = RefereePermission::kStop; }},
      {msg::REFUSAL_STALE, [](Case& c) { c.order.valid_until_t_ns = kNow_ns - 1; }},
      {msg::REFUSAL_DOUBLE, [](Case& c) { c.before = {order_at(kNow_ns - 900 * kMs, c.order.kick_id)}; }},
      {msg::REFUSAL_CHARGING, [](Case& c) { c.sample.charge = 0.5; }}};
  for (std::size_t first = 0; first < in_order.size(); ++first) {
    for (std::size_t second = first; second < in_order.size(); ++second) {
      Case c;
      in_order[second].make(c);
      in_order[first].make(c);
      EXPECT_EQ(c.answer(), in_order[first].refusal) << bus::label(in_order[second].refusal);
    }
  }
}

TEST(OrderGate, CountsAndRemembersItsAnswers) {
  OrderGate gate = Case{}.gate();
  EXPECT_EQ(gate.handled(), 0u);
  EXPECT_EQ(gate.last_kick_id(), 0);
  gate.judge(order_at(kNow_ns, 5), kNow_ns, OrderBy::kOwnDecision);
  EXPECT_TRUE(gate.last_accepted());
  gate.judge(order_at(kNow_ns, 6), kNow_ns, OrderBy::kOwnDecision);
  EXPECT_EQ(gate.handled(), 2u);
  EXPECT_EQ(gate.refused(), 1u);
  EXPECT_EQ(gate.last_kick_id(), 6);
  EXPECT_FALSE(gate.last_accepted());
}

TEST(OrderGate, IsReadyExactlyWhenItWouldAccept) {
  int ready = 0, not_ready = 0;
  for (const double charge : {0.2, 0.95})
    for (const bool armed : {false, true})
      for (const bool playing : {false, true})
        for (const bool received : {false, true})
          for (const auto fault : {hal::KickerFault::kNone, hal::KickerFault::kCharger})
            for (const std::int64_t sample_age_ms : {0, 50, 150})
              for (const std::int64_t last_kick_ms : {0, 100, 499, 500, 5000}) {
                Case c;
                c.received = received;
                c.referee = playing ? RefereePermission::kPlay : RefereePermission::kSilent;
                c.sample = {kNow_ns - sample_age_ms * kMs, charge, armed, fault};
                if (last_kick_ms > 0) c.before = {order_at(kNow_ns - last_kick_ms * kMs, 1)};
                if (!received) c.before.clear();
                c.order.kick_id = 2;
                OrderGate gate = c.gate();
                const bool said = gate.ready(kNow_ns);
                EXPECT_EQ(said, gate.judge(c.order, kNow_ns, OrderBy::kOwnDecision) == msg::REFUSAL_NONE);
                ++(said ? ready : not_ready);
              }
  EXPECT_GT(ready, 0);
  EXPECT_GT(not_ready, 0);
}

TEST(OrderGate, AcceptsNoOrderTwiceAndNoTwoWithinTheInterval) {
  std::mt19937_64 random{23};
  const auto chance = [&](double p) { return std::bernoulli_distribution{p}(random); };
  config::KickerDriver settings;
  OrderGate gate{settings, {{15.0, 50.0}}, kCycle_s};
  std::set<std::int64_t> accepted;
  std::int64_t now_ns = kNow_ns, last_fire_ns = 0, next_id = 1;
  int repeats = 0;
  for (int i = 0; i < 20000; ++i) {
    now_ns += static_cast<std::int64_t>(random() % 100) * kMs;
    gate.device({now_ns, chance(0.9) ? 1.0 : 0.3, chance(0.95), hal::KickerFault::kNone});
    gate.referee(chance(0.95) ? RefereePermission::kPlay : RefereePermission::kStop);
    const bool again = chance(0.5) && next_id > 1;
    const std::int64_t back = std::min<std::int64_t>(next_id - 1, 1 + static_cast<std::int64_t>(random() % 60));
    const std::int64_t id = again ? next_id - back : next_id++;
    repeats += again;
    if (gate.judge(order_at(now_ns, id), now_ns, OrderBy::kOwnDecision) != msg::REFUSAL_NONE) continue;
    EXPECT_TRUE(accepted.insert(id).second) << id;
    EXPECT_GE(now_ns - last_fire_ns, 500 * kMs);
    last_fire_ns = now_ns;
  }
  EXPECT_GT(accepted.size(), 500u);
  EXPECT_GT(repeats, 5000);
}

/// A number that somebody might send: near now, near an end of the type, or anything.
rc::Gen<std::int64_t> any_instant() {
  return rc::gen::oneOf(
      rc::gen::map(rc::gen::inRange<std::int64_t>(-300, 300), [](std::int64_t ms) { return kNow_ns + ms * kMs / 2; }),
      rc::gen::element<std::int64_t>(0, 1, -1, kLeast, kLeast + 1, kMost, kMost - 1, kNow_ns),
      rc::gen::arbitrary<std::int64_t>());
}

TEST(OrderGate, OverTheWholeMessageOnlyAFreshOrderOfANewKickWithinRangeFires) {
  int fired = 0;
  EXPECT_TRUE(rc::check([&fired] {
    Case c;
    c.before = {order_at(kNow_ns - 1000 * kMs, 3)};
    msg::KickOrder& order = c.order;
    const bool near = *rc::gen::arbitrary<bool>();  // else hardly any fires
    order.t_ns = near ? kNow_ns - *rc::gen::inRange<std::int64_t>(0, 120) * kMs : *any_instant();
    order.fire_t_ns = near ? order.t_ns + *rc::gen::inRange<std::int64_t>(0, 25) * kMs : *any_instant();
    order.valid_until_t_ns = *any_instant();
    order.kick_id = *rc::gen::oneOf(rc::gen::inRange<std::int64_t>(1, 6), any_instant());
    order.power = *rc::gen::oneOf(rc::gen::map(rc::gen::inRange(10, 60), [](int power) { return 1.0 * power; }),
                                  rc::gen::element(std::nan(""), HUGE_VAL, -HUGE_VAL, -0.0, 1e308, 15.0, 50.0));
    if (c.answer() != msg::REFUSAL_NONE) return;
    ++fired;
    // In words of the wire, not of the gate: no overflow, since only instants around now pass.
    RC_ASSERT(order.power >= 15.0 && order.power <= 50.0);
    RC_ASSERT(order.kick_id > 0 && order.kick_id != 3);
    RC_ASSERT(order.t_ns >= kNow_ns - 100 * kMs && order.t_ns <= kNow_ns + 25 * kMs);
    RC_ASSERT(order.valid_until_t_ns >= kNow_ns);
    RC_ASSERT(order.fire_t_ns >= order.t_ns && order.fire_t_ns <= order.t_ns + 20 * kMs + 1);
    RC_ASSERT(order.fire_t_ns <= kNow_ns + 25 * kMs);
  }));
  EXPECT_GT(fired, 0);
}

}  // namespace
}  // namespace trivela::robot
