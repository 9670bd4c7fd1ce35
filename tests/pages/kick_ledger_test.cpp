#include "pages/monitor/kick_ledger.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "kicking/geometry/angle.hpp"
#include "tests/pages/kicks_of_a_match.hpp"

namespace trivela::pages {
namespace {

constexpr std::int64_t kNow = 5 * kSecond_ns;

KickTally moving(const KickLedger& ledger, const LedgerNow& now = {.received_ns = kNow}) {
  const auto tallies = ledger.tallies(now);
  const auto found = tallies.find(msg::POLICY_MOVING);
  return found == tallies.end() ? KickTally{} : found->second;
}

TEST(KickLedger, JoinsThreeWordsOfAKickInEveryOrderAndCountsItOnce) {
  const std::vector<std::function<void(KickLedger&)>> words{
      [](KickLedger& ledger) { ledger.receive(decision(1, 7, msg::POLICY_MOVING), kNow); },
      [](KickLedger& ledger) { ledger.receive(receipt(1, 7, true), kNow); },
      [](KickLedger& ledger) { ledger.receive(outcome(1, 7, msg::OUTCOME_ON_TARGET), kNow); }};
  std::vector<std::size_t> order{0, 1, 2};
  do {
    KickLedger ledger;
    for (int again = 0; again < 2; ++again)
      for (const std::size_t word : order) words[word](ledger);
    EXPECT_EQ(moving(ledger).inside, 1);
    EXPECT_EQ(moving(ledger).outside + moving(ledger).unknown + moving(ledger).under_way, 0);
    EXPECT_EQ(ledger.tallies({.received_ns = kNow}).size(), 1u);
    EXPECT_EQ(ledger.latest(9).size(), 1u);
  } while (std::ranges::next_permutation(order).found);
}

TEST(KickLedger, TheSameNumberOfTwoRobotsIsTwoKicks) {
  KickLedger ledger;
  for (const std::uint8_t robot : {std::uint8_t{1}, std::uint8_t{2}}) {
    ledger.receive(decision(robot, 7, msg::POLICY_MOVING), kNow);
    ledger.receive(outcome(robot, 7, robot == 1 ? msg::OUTCOME_ON_TARGET : msg::OUTCOME_OVER), kNow);
  }
  EXPECT_EQ(moving(ledger).inside, 1);
  EXPECT_EQ(moving(ledger).outside, 1);
}

TEST(KickLedger, ARefusedOrderIsNoKickAndOneThatIsCalledOffIsNoneAfterAll) {
  KickLedger ledger;
  ledger.receive(decision(1, 7, msg::POLICY_MOVING), kNow);
  ledger.receive(receipt(1, 7, true, 1), kNow);
  EXPECT_EQ(moving(ledger).under_way, 1);
  ledger.receive(receipt(1, 7, false, 2, msg::REFUSAL_UNARMED), kNow);
  EXPECT_EQ(moving(ledger).under_way, 0);
  EXPECT_EQ(moving(ledger).refused, 1);
  ledger.receive(receipt(1, 7, true, 1), kNow);
  EXPECT_EQ(moving(ledger).refused, 1) << "the earlier receipt, heard once more";
}

TEST(KickLedger, TheReceiptOfARestartedDriverHoldsThoughItsSeqIsLower) {
  KickLedger ledger;
  ledger.receive(decision(1, 7, msg::POLICY_MOVING), kNow);
  ledger.receive(receipt(1, 7, true, 20), kNow);
  msg::KickReceipt of_successor = receipt(1, 7, false, 1, msg::REFUSAL_FAULT);
  of_successor.t_ns = kNow;
  ledger.receive(of_successor, kNow);
  EXPECT_EQ(moving(ledger).under_way, 0);
  EXPECT_EQ(moving(ledger).refused, 1);
}

TEST(KickLedger, AnOrderThatCameTwiceStaysFired) {
  KickLedger ledger;
  ledger.receive(decision(1, 7, msg::POLICY_MOVING), kNow);
  ledger.receive(receipt(1, 7, true, 1), kNow);
  ledger.receive(receipt(1, 7, false, 2, msg::REFUSAL_DOUBLE), kNow);
  EXPECT_EQ(moving(ledger).under_way, 1);
  EXPECT_EQ(moving(ledger).refused, 0);
}

TEST(KickLedger, TheLastOutcomeCounts) {
  KickLedger ledger;
  ledger.receive(decision(1, 7, msg::POLICY_MOVING), kNow);
  ledger.receive(outcome(1, 7, msg::OUTCOME_UNKNOWN, 3), kNow);
  EXPECT_EQ(moving(ledger).unknown, 1);
  ledger.receive(outcome(1, 7, msg::OUTCOME_POST, 4), kNow);
  EXPECT_EQ(moving(ledger).unknown, 0);
  EXPECT_EQ(moving(ledger).outside, 1);
  ledger.receive(outcome(1, 7, msg::OUTCOME_UNKNOWN, 3), kNow);
  EXPECT_EQ(moving(ledger).outside, 1) << "the earlier one, late";
}

TEST(KickLedger, AnOutcomeThatDoesNotComeIsUnknownAfterTenSecondsOfTheRobotAndCountsWhenItComesLate) {
  KickLedger ledger;
  ledger.receive(decision(1, 7, msg::POLICY_MOVING), kNow);
  const auto robot_at = [](std::int64_t t_ns) { return LedgerNow{.received_ns = kNow, .robots_t_ns = {{1, t_ns}}}; };
  EXPECT_EQ(moving(ledger, robot_at(kSecond_ns + kOutcomeTimeout_ns)).under_way, 1);
  const LedgerNow late = robot_at(kSecond_ns + kOutcomeTimeout_ns + 1);
  EXPECT_EQ(moving(ledger, late).unknown, 1);
  ledger.receive(outcome(1, 7, msg::OUTCOME_ON_TARGET), kNow);
  EXPECT_EQ(moving(ledger, late).unknown, 0);
  EXPECT_EQ(moving(ledger, late).inside, 1);
}

TEST(KickLedger, OfASilentRobotAnOutcomeIsWaitedForAMinuteAndAfterTheMatchNotAtAll) {
  KickLedger ledger;
  ledger.receive(decision(1, 7, msg::POLICY_MOVING), kNow);
  EXPECT_EQ(moving(ledger, {.received_ns = kNow + kSilenceTimeout_ns}).under_way, 1);
  EXPECT_EQ(moving(ledger, {.received_ns = kNow + kSilenceTimeout_ns + 1}).unknown, 1);
  EXPECT_EQ(moving(ledger, {.received_ns = kNow, .over = true}).unknown, 1);
}

TEST(KickLedger, AKickWhoseDecisionWasNotHeardStandsApart) {
  KickLedger ledger;
  ledger.receive(outcome(1, 7, msg::OUTCOME_ON_TARGET), kNow);
  const auto tallies = ledger.tallies({.received_ns = kNow});
  ASSERT_TRUE(tallies.contains(std::nullopt));
  EXPECT_EQ(tallies.at(std::nullopt).inside, 1);
  ledger.receive(decision(1, 7, msg::POLICY_STOPPED), kNow);
  EXPECT_EQ(ledger.tallies({.received_ns = kNow}).at(msg::POLICY_STOPPED).inside, 1) << "it came late";
}

TEST(KickLedger, DecisionsToHoldAndNumbersThatAreNoneAreNoKicks) {
  KickLedger ledger;
  ledger.receive(decision(1, 0, msg::POLICY_MOVING), kNow);
  ledger.receive(outcome(1, -3, msg::OUTCOME_ON_TARGET), kNow);
  ledger.receive(outcome(0, 7, msg::OUTCOME_ON_TARGET), kNow);
  EXPECT_TRUE(ledger.tallies({.received_ns = kNow}).empty());
}

TEST(KickLedger, AGoalFromTheOwnHalfIsOutsideWhereTheRulesSaySo) {
  for (const bool rule : {false, true}) {
    KickLedger ledger{{.opponents_half_only = rule, .ball_offset_m = 0.27}};
    msg::KickDecision own = decision(1, 7, msg::POLICY_MOVING);
    own.y_m = -0.3;
    ledger.receive(own, kNow);
    ledger.receive(outcome(1, 7, msg::OUTCOME_ON_TARGET), kNow);
    msg::KickDecision across = decision(1, 8, msg::POLICY_MOVING);
    across.y_m = -0.2;  // the ball lies before the robot
    ledger.receive(across, kNow);
    ledger.receive(outcome(1, 8, msg::OUTCOME_ON_TARGET), kNow);
    EXPECT_EQ(moving(ledger).inside, rule ? 1 : 2);
    EXPECT_EQ(moving(ledger).outside, rule ? 1 : 0);
  }
}

TEST(KickLedger, AGoalAfterTheBallWasCarriedTooFarIsOutsideWhereTheRulesSaySo) {
  const auto inside_after = [](double limit_m,
                               std::initializer_list<std::tuple<std::uint32_t, double, bool>> decisions) {
    KickLedger ledger{{.carry_limit_m = limit_m, .ball_offset_m = 0.27}};
    std::int64_t seq = 0;
    for (const auto& [possession_id, y_m, fire] : decisions) {
      msg::KickDecision said = decision(1, fire ? 7 : 0, msg::POLICY_MOVING);
      said.seq = static_cast<std::uint64_t>(++seq);
      said.fire = fire;
      said.possession_id = 4 + (possession_id > 4 ? 1 : 0);
      said.reason = possession_id == 0 ? msg::REASON_NOT_PLAYING : msg::REASON_NOT_ALIGNED;
      said.y_m = y_m;
      ledger.receive(said, kNow);
    }
    ledger.receive(outcome(1, 7, msg::OUTCOME_ON_TARGET), kNow);
    return moving(ledger).inside;
  };
  EXPECT_EQ(inside_after(3.0, {{4, 1.0, false}, {4, 3.9, true}}), 1);
  EXPECT_EQ(inside_after(3.0, {{4, 1.0, false}, {4, 4.1, true}}), 0);
  EXPECT_EQ(inside_after(3.0, {{0, 9.0, false}, {4, 1.0, false}, {4, 3.9, true}}), 1) << "the game stood where 0 is";
  EXPECT_EQ(inside_after(0.0, {{4, 1.0, false}, {4, 4.1, true}}), 1) << "no limit";
  EXPECT_EQ(inside_after(3.0, {{4, 1.0, false}, {5, 2.0, false}, {5, 4.1, true}}), 1) << "another possession";
}

TEST(KickLedger, KeepsNoMoreKicksThanItsPlacesAndSaysSo) {
  KickLedger ledger;
  const auto most = static_cast<std::int64_t>(KickLedger::kMostKicks);
  for (std::int64_t kick = 1; kick <= most + 5; ++kick) ledger.receive(outcome(1, kick, msg::OUTCOME_OVER), kNow);
  EXPECT_EQ(ledger.not_kept(), 5);
  EXPECT_EQ(ledger.tallies({.received_ns = kNow}).at(std::nullopt).outside, most);
  EXPECT_EQ(ledger.latest(3).front().kick_id, most);
}

}  // namespace
}  // namespace trivela::pages
