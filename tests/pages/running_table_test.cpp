#include "pages/monitor/kick_ledger.hpp"

#include <gmock/gmock.h>

#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/evaluator/random_numbers.hpp"
#include "tests/pages/kicks_of_a_match.hpp"

namespace trivela::pages {
namespace {

using evaluator::RandomNumbers;

TEST(RunningTable, HasARowAPolicyInTheirOrderAndTheDifferenceOfTheFirstTwoThatKicked) {
  const RunningTable table = running_table({{std::nullopt, {.inside = 2}},
                                            {msg::POLICY_PREDICTIVE, {.inside = 9, .outside = 1}},
                                            {msg::POLICY_STOPPED, {.under_way = 1}},
                                            {msg::POLICY_MOVING, {.inside = 5, .outside = 5, .unknown = 3}}});
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[0].policy, "stopped");
  EXPECT_EQ(table.rows[1].policy, "moving");
  EXPECT_EQ(table.rows[2].policy, "predictive");
  EXPECT_EQ(table.rows[3].policy, "not received");
  EXPECT_EQ(table.rows[0].interval.lo, 0.0) << "nothing is known yet";
  EXPECT_EQ(table.rows[0].interval.hi, 1.0);
  EXPECT_EQ(table.rows[1].counts().n, 10) << "an unknown outcome is neither";
  EXPECT_NEAR(table.rows[1].interval.lo, 0.1292190124, 1e-9) << "5 of 10, computed with Python's math.lgamma";
  EXPECT_NEAR(table.rows[1].interval.hi, 0.8707809876, 1e-9);
  ASSERT_TRUE(table.difference);
  EXPECT_EQ(table.difference->older, "moving") << "stopped has no kick with an outcome";
  EXPECT_EQ(table.difference->newer, "predictive");
  EXPECT_NEAR(table.difference->value, 0.4, 1e-12);
}

TEST(RunningTable, OfOnePolicyThereIsNoDifference) {
  EXPECT_FALSE(running_table({{msg::POLICY_MOVING, {.inside = 5}}, {std::nullopt, {.inside = 5}}}).difference);
  EXPECT_TRUE(running_table({}).rows.empty());
}

/// A match that somebody watches: kicks of two policies, drawn for each, come in one after the other, some with
/// outcomes that are unknown for now or for good.
class WatchedMatch {
 public:
  WatchedMatch(std::uint64_t seed, double p_stopped, double p_moving)
      : random_(seed), p_{{msg::POLICY_STOPPED, p_stopped}, {msg::POLICY_MOVING, p_moving}} {}

  void kick() {
    const std::int64_t id = ++kicks_;
    const msg::Policy policy = random_.happens(0.5) ? msg::POLICY_MOVING : msg::POLICY_STOPPED;
    const bool inside = random_.happens(p_.at(policy));
    ledger_.receive(decision(1, id, policy, static_cast<std::uint64_t>(id)), id);
    ledger_.receive(receipt(1, id, true, static_cast<std::uint64_t>(id)), id);
    if (random_.happens(0.05)) return;  // whatever became of it
    ledger_.receive(
        outcome(1, id, inside ? msg::OUTCOME_ON_TARGET : msg::OUTCOME_WIDE_LEFT, static_cast<std::uint64_t>(id)), id);
  }
  std::map<std::optional<PolicyLabel>, KickTally> tallies() const { return ledger_.tallies({.received_ns = kicks_}); }

 private:
  RandomNumbers random_;
  std::map<msg::Policy, double> p_;
  KickLedger ledger_;
  std::int64_t kicks_ = 0;
};

/// Tables of the same counts have the same intervals.
class KnownTables {
 public:
  const RunningTable& of(const std::map<std::optional<PolicyLabel>, KickTally>& tallies) {
    Key key;
    for (const auto& [policy, kicks] : tallies) key.push_back({policy, kicks.inside, kicks.outside});
    auto [known, fresh] = tables_.try_emplace(key);
    if (fresh) known->second = running_table(tallies);
    return known->second;
  }

 private:
  using Key = std::vector<std::tuple<std::optional<PolicyLabel>, std::int64_t, std::int64_t>>;
  std::map<Key, RunningTable> tables_;
};

bool holds(const evaluator::stats::Interval& interval, double truth) {
  return interval.lo <= truth && truth <= interval.hi;
}

/// How many of 1,000 matches of 40 kicks ever show an interval without the truth to who looks after each kick: of the
/// two policies' parts and of the difference.
std::pair<int, int> wrong_matches(double p_stopped, double p_moving, std::uint64_t seed) {
  KnownTables tables;
  int wrong_part = 0, wrong_difference = 0;
  for (std::uint64_t match = 0; match < 1000; ++match) {
    WatchedMatch watched{seed + match, p_stopped, p_moving};
    bool part = false, difference = false;
    for (int look = 0; look < 40; ++look) {
      watched.kick();
      const RunningTable& table = tables.of(watched.tallies());
      for (const RunningRow& row : table.rows)
        part = part || (row.policy == "moving" && !holds(row.interval, p_moving));
      difference = difference || (table.difference && !holds(table.difference->interval, p_moving - p_stopped));
    }
    wrong_part += part ? 1 : 0;
    wrong_difference += difference ? 1 : 0;
  }
  return {wrong_part, wrong_difference};
}

TEST(PeekingAtTheTable, AfterEveryKickOfAThousandMatchesErrsInUnderFivePercent) {
  const auto [part, difference] = wrong_matches(0.5, 0.8, 70'001);
  EXPECT_LT(part, 50);
  EXPECT_LT(difference, 50);
  EXPECT_GT(part, 0) << "an interval that is never wrong says nothing";
}

TEST(PeekingAtTheTable, AtTwoPoliciesThatAreAlikeFindsADifferenceInUnderFivePercent) {
  EXPECT_LT(wrong_matches(0.7, 0.7, 80'001).second, 50);
}

}  // namespace
}  // namespace trivela::pages
