#include "evaluator/compare/policy_comparison.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "evaluator/counting/log_kicks.hpp"
#include "evaluator/stats/test_plan.hpp"
#include "evaluator/table2/table2.hpp"
#include "tests/evaluator/experiment_fixture.hpp"
#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/random_numbers.hpp"
#include "tests/evaluator/report_of_log.hpp"

namespace trivela::evaluator {
namespace {

using testing::HasSubstr;
using testing::Not;

class PolicyComparisonTest : public LogTest {
 protected:
  PolicyComparison compared(LogKicks options = {}, std::vector<std::string> files = {"match.db"}) const {
    std::vector<std::filesystem::path> logs;
    for (const std::string& file : files) logs.push_back(path(file));
    std::string by;
    KickDataset dataset = read_log_kicks(logs, options, by);
    return compare_policies(std::move(dataset), by);
  }

  std::string message_of(LogKicks options = {}) const {
    try {
      compared(std::move(options));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  // Two arms on the same `matches` times 10 opportunities; the newer one kicks always and is on target in 7 of them,
  // the older one kicks in 6 and is on target in 4 or 5.
  void write_paired(std::uint32_t matches) {
    TestExperiment experiment(path(), matches);
    for (std::uint32_t match = 0; match < matches; ++match) {
      experiment.begin();
      experiment.session(match, 0, "slow", {{1, "stopped"}});
      experiment.played(1, 10.0);
      for (std::int64_t i = 1; i <= 10; ++i) {
        experiment.possession(1, i, "stopped", 1.0,
                              i <= 4 + match % 2 ? std::optional(kIn)
                              : i <= 6           ? std::optional(kOut)
                                                 : std::nullopt);
      }
      experiment.session(match, 1, "quick", {{1, "moving"}});
      experiment.played(1, 10.0);
      for (std::int64_t i = 1; i <= 10; ++i) experiment.possession(1, i, "moving", 1.0, i >= 4 ? kIn : kOut);
      experiment.commit();
    }
    experiment.finish();
  }
};

// Six matches of ten opportunities, on target in all of them. `low` bounces in and is saved in eight, `high` in three.
void write_saves(const std::filesystem::path& path) {
  const LoggedKick saved{"on_target", "on_target", 4.0, true, true, 0.9},
      goal{"on_target", "on_target", 4.0, false, false, 0.1};
  TestExperiment experiment(path, 6);
  for (std::uint32_t match = 0; match < 6; ++match) {
    experiment.begin();
    for (const std::uint32_t arm : {0U, 1U}) {
      experiment.session(match, arm, arm == 0 ? "low" : "high", {{1, "moving"}});
      for (std::int64_t i = 1; i <= 10; ++i)
        experiment.possession(1, i, "moving", 1.0, i <= (arm == 0 ? 7 + match % 3 : 3) ? saved : goal);
    }
    experiment.commit();
  }
  experiment.finish();
}

TEST_F(PolicyComparisonTest, GoalsAreCountedPastTheKeeperBesideWhatIsInside) {
  write_saves(path());
  const auto result = compared();
  EXPECT_EQ(result.groups[0].inside(), 60);
  EXPECT_EQ(result.groups[0].goals(), 12);
  EXPECT_EQ(result.groups[1].goals(), 42);
  const PairResult& pair = result.pairs[0];
  EXPECT_NEAR(pair.headline->difference, 0.0, 1e-12) << "Table 2 sees no keeper";
  ASSERT_TRUE(pair.goals);
  EXPECT_NEAR(pair.goals->difference, 0.5, 1e-12);
  ASSERT_TRUE(pair.goals->clustered);
  EXPECT_GT(pair.goals->clustered->ci.lo, 0.3);
  const std::string text = to_text(result);
  EXPECT_THAT(text, HasSubstr("Goals: inside and not saved, observed"));
  EXPECT_THAT(text, HasSubstr("by the simulator's truth: low 48 of 60, high 18 of 60"));
  EXPECT_THAT(text, HasSubstr("saved by a keeper, of those inside, as observed: low 48 of 60, high 18 of 60"));
  EXPECT_THAT(to_json(result), HasSubstr("\"goals_per_opportunity\""));
}

TEST_F(PolicyComparisonTest, WithoutAKeeperThereIsOneHeadline) {
  write_paired(10);
  const auto result = compared();
  EXPECT_FALSE(result.pairs[0].goals);
  EXPECT_THAT(to_text(result), Not(HasSubstr("Goals:")));
}

TEST_F(PolicyComparisonTest, BlockedKicksAreOutsideUnlessTheyStandApart) {
  const LoggedKick blocked{"blocked", "blocked", 4.0};
  TestExperiment experiment(path(), 6);
  for (std::uint32_t match = 0; match < 6; ++match) {
    experiment.begin();
    for (const std::uint32_t arm : {0U, 1U}) {
      experiment.session(match, arm, arm == 0 ? "a" : "b", {{1, "moving"}});
      for (std::int64_t i = 1; i <= 10; ++i)
        experiment.possession(1, i, "moving", 1.0, i <= 5 ? kIn : i <= (arm == 0 ? 9 : 6) ? blocked : kOut);
    }
    experiment.commit();
  }
  experiment.finish();
  const auto outside = compared();
  EXPECT_EQ(outside.groups[0].outside(), 30);
  EXPECT_EQ(outside.groups[0].kicks(), 60);
  EXPECT_NEAR(outside.pairs[0].efficiency->difference, 0.0, 1e-12);
  EXPECT_THAT(to_text(outside), Not(HasSubstr("stand apart")));
  const auto apart = compared({.blocked_apart = true});
  EXPECT_EQ(apart.groups[0].blocked(), 24);
  EXPECT_EQ(apart.groups[0].outside(), 6);
  EXPECT_EQ(apart.groups[0].kicks(), 60);
  EXPECT_NEAR(apart.pairs[0].efficiency->difference, 30.0 / 54.0 - 30.0 / 36.0, 1e-12);
  EXPECT_NEAR(apart.pairs[0].per_opportunity->difference, 0.0, 1e-12) << "an opportunity stays one";
  EXPECT_THAT(to_text(apart), HasSubstr("blocked kicks stand apart"));
}

TEST_F(PolicyComparisonTest, ArmsOnTheSameOpportunitiesArePaired) {
  write_paired(10);
  const auto result = compared();
  EXPECT_EQ(result.by, "arm");
  ASSERT_EQ(result.pairs.size(), 1U);
  const PairResult& pair = result.pairs[0];
  EXPECT_EQ(pair.older, "slow");
  EXPECT_EQ(pair.design, Design::kPaired);
  ASSERT_TRUE(pair.pairs);
  EXPECT_EQ(pair.pairs->n(), 100);
  EXPECT_EQ(pair.pairs->newer_only, 5 * 6 + 5 * 5);
  EXPECT_EQ(pair.pairs->older_only, 30);
  EXPECT_EQ(pair.unpaired, 0);
  EXPECT_NEAR(pair.headline->difference, 0.7 - 0.45, 1e-12);
  EXPECT_TRUE(pair.headline->by_match);
  EXPECT_TRUE(pair.headline->of_opportunities);
  EXPECT_NEAR(*result.groups[0].played_min, 100.0, 1e-9);
  EXPECT_NEAR(pair.kick_rate->value, 100.0 / 60.0, 1e-12);
  EXPECT_EQ(result.groups[0].kicks(), 60);
  EXPECT_EQ(result.groups[0].opportunities, 100);
  const std::string text = to_text(result);
  EXPECT_THAT(text, HasSubstr("quick is better than slow in shots on target an opportunity: +25.0 percentage points"));
  EXPECT_THAT(text, HasSubstr("both had the same opportunities"));
  EXPECT_THAT(text, HasSubstr("SIMULATED"));
  EXPECT_THAT(text, HasSubstr("McNemar"));
}

TEST_F(PolicyComparisonTest, WhereNothingIsClusteredAsManyAreNeededAsOfTheSameCounts) {
  TestExperiment experiment(path(), 1);
  experiment.begin();
  experiment.session(0, 0, "", {{1, "stopped"}, {2, "moving"}});
  for (std::int64_t i = 1; i <= 39; ++i) experiment.possession(1, i, "stopped", 1.0, i <= 15 ? kIn : kOut);
  for (std::int64_t i = 1; i <= 41; ++i) experiment.possession(2, i, "moving", 1.0, i <= 22 ? kIn : kOut);
  experiment.commit();
  experiment.finish();
  const auto result = compared();
  const Headline& headline = *result.pairs[0].headline;
  EXPECT_FALSE(headline.by_match);
  EXPECT_NEAR(*headline.needed_for_seen, *stats::kicks_per_policy(15.0 / 39.0, 22.0 / 41.0), 1e-9);
}

TEST_F(PolicyComparisonTest, MinutesOfSomeOfTheKicksMakeNoRate) {
  write_paired(6);
  EXPECT_TRUE(compared().groups[0].kicks_per_min());
  TestExperiment experiment(path("untimed.db"), 1);
  experiment.run = "untimed";
  experiment.begin();
  experiment.session(7, 0, "slow", {{1, "stopped"}});
  experiment.possession(1, 1, "stopped", 1.0, kIn);
  experiment.commit();
  experiment.finish();
  const auto result = compared({.by = "policy"}, {"match.db", "untimed.db"});
  EXPECT_FALSE(result.groups[0].kicks_per_min()) << "stopped";
  EXPECT_TRUE(result.groups[1].kicks_per_min()) << "moving";
}

TEST_F(PolicyComparisonTest, MinutesOfSomeOfTheKicksMakeNoRateInAReportEither) {
  TestExperiment experiment(path(), 2);
  experiment.begin();
  experiment.session(0, 0, "", {{1, "stopped"}, {2, "moving"}});
  experiment.played(1, 10.0);
  experiment.played(2, 10.0);
  experiment.possession(1, 1, "stopped", 1.0, kIn);
  experiment.possession(2, 2, "moving", 1.0, kIn);
  experiment.session(1, 0, "", {{1, "stopped"}});
  experiment.possession(1, 1, "stopped", 1.0, kIn);
  experiment.commit();
  experiment.finish();
  const Report report = make_report(log::Reader(path()));
  ASSERT_EQ(report.policies.size(), 2U);
  EXPECT_FALSE(report.policies[0].kicks_per_min()) << "stopped";
  EXPECT_TRUE(report.policies[1].kicks_per_min()) << "moving";
  EXPECT_FALSE((KickCounts(report.policies[1]) += report.policies[0]).kicks_per_min()) << "together";
}

TEST_F(PolicyComparisonTest, StrataLeaveTheCrudeDifferenceAsItIs) {
  write_paired(10);
  const auto crude = compared().pairs[0].efficiency->clustered;
  const auto stratified = compared({.stratify = "distance"}).pairs[0].efficiency->clustered;
  ASSERT_TRUE(crude && stratified);
  EXPECT_EQ(stratified->ci.lo, crude->ci.lo);
  EXPECT_EQ(stratified->ci.hi, crude->ci.hi);
}

TEST_F(PolicyComparisonTest, TheSameArmsByPolicyOrTableAreReadToo) {
  write_paired(6);
  EXPECT_EQ(compared({.by = "policy"}).groups[0].name, "stopped");
  EXPECT_EQ(compared({.by = "policy"}).pairs[0].design, Design::kPaired);
  EXPECT_THAT(message_of({.by = "table"}), HasSubstr("the only table is 'new'"));
  EXPECT_THAT(message_of({.by = "robot"}), HasSubstr("the only robot is 'robot 1'"));
  EXPECT_THAT(message_of({.by = "floor"}), testing::StartsWith("by 'floor': a match log is compared by"));
  EXPECT_THAT(message_of({.stratify = "floor"}), testing::StartsWith("stratify 'floor': a match log has"));
}

TEST_F(PolicyComparisonTest, FewMatchesGiveTheIntervalOfPairsAndSaySo) {
  write_paired(3);
  const auto result = compared();
  EXPECT_FALSE(result.pairs[0].headline->by_match);
  EXPECT_EQ(result.pairs[0].headline->method, "Newcombe's for pairs");
  EXPECT_THAT(to_text(result), HasSubstr("Fewer than five matches"));
}

TEST_F(PolicyComparisonTest, DistanceStrataAreOfKicksAndStartDistancesOfOpportunities) {
  write_paired(6);
  const auto kicks = compared({.stratify = "distance"});
  EXPECT_FALSE(kicks.pairs[0].stratified->of_opportunities);
  EXPECT_FALSE(kicks.pairs[0].headline->adjusted);
  const auto starts = compared({.stratify = "start_distance"});
  EXPECT_TRUE(starts.pairs[0].stratified->of_opportunities);
  EXPECT_EQ(starts.pairs[0].stratified->strata[0].name, "5 to 6 m") << "0.5 m beside and 5 m before the goal";
}

TEST_F(PolicyComparisonTest, TruthAndObservationAreChosen) {
  TestExperiment experiment(path(), 1);
  experiment.begin();
  for (const std::uint32_t arm : {0U, 1U}) {
    experiment.session(0, arm, arm == 0 ? "a" : "b", {{1, "moving"}});
    experiment.possession(1, 1, "moving", 1.0, LoggedKick{"on_target", "post", 4.0});
    experiment.possession(1, 2, "moving", 1.0, LoggedKick{"", "on_target", 4.0});
    experiment.possession(1, 3, "moving", 1.0, LoggedKick{"unknown", "on_target", 4.0});
  }
  experiment.commit();
  experiment.finish();
  const auto observed = compared(), truth = compared({.truth = true});
  EXPECT_EQ(observed.groups[0].inside(), 1);
  EXPECT_EQ(observed.groups[0].unknown(), 2);
  EXPECT_EQ(truth.groups[0].inside(), 2);
  EXPECT_EQ(truth.groups[0].unknown(), 0);
  EXPECT_EQ(observed.pairs[0].pairs->n(), 3)
      << "an opportunity with an unknown outcome is one without a shot on target";
  EXPECT_NEAR(observed.pairs[0].bounds.hi, 2.0 / 3.0, 1e-12) << "and bounded by what it may have been";
  EXPECT_EQ(truth.pairs[0].pairs->n(), 3);
}

TEST_F(PolicyComparisonTest, PoliciesDrawnAtRandomAreRandomisedAndTheirSharesChecked) {
  const auto write = [&](const char* file, double share) {
    RandomNumbers random(11);
    TestExperiment experiment(path(file), 8);
    for (std::uint32_t match = 0; match < 8; ++match) {
      experiment.begin();
      experiment.session(match, 0, "", {}, false);
      for (std::int64_t i = 1; i <= 60; ++i) {
        const bool moving = random.happens(share);
        experiment.possession(1, i, moving ? "moving" : "stopped", moving ? 0.75 : 0.25,
                              random.happens(moving ? 0.8 : 0.3) ? kIn : kOut);
      }
      experiment.commit();
    }
    experiment.finish();
  };
  write("match.db", 0.75);
  const auto result = compared();
  EXPECT_EQ(result.pairs[0].design, Design::kRandomised);
  EXPECT_GT(*result.sample_ratio_p, 0.001);
  EXPECT_THAT(to_text(result), HasSubstr("because of the policy: it was drawn at random"));
  EXPECT_FALSE(result.groups[0].played_min) << "the minutes of a half are nobody's alone";
  write("odd.db", 0.5);
  EXPECT_LT(*compared({}, {"odd.db"}).sample_ratio_p, 0.001);
  EXPECT_THAT(to_text(compared({}, {"odd.db"})), HasSubstr("did not go as planned"));
}

TEST_F(PolicyComparisonTest, BesideDrawnPoliciesCertainOnesAreLeftOut) {
  TestExperiment experiment(path(), 6);
  for (std::uint32_t match = 0; match < 6; ++match) {
    experiment.begin();
    experiment.session(match, 0, "drawn", {});
    for (std::int64_t i = 1; i <= 8; ++i) {
      experiment.possession(1, i, i % 2 == 0 ? "moving" : "stopped", 0.5, i < 5 ? kIn : kOut);
    }
    experiment.session(match, 1, "certain", {{1, "moving"}});
    for (std::int64_t i = 1; i <= 8; ++i) experiment.possession(1, i, "moving", 1.0, kIn);
    experiment.commit();
  }
  experiment.finish();
  const auto result = compared({.by = "policy"});
  EXPECT_EQ(result.pairs[0].design, Design::kRandomised);
  EXPECT_EQ(result.groups[1].opportunities, 24);
  EXPECT_THAT(to_text(result), HasSubstr("48 opportunities left out"));
}

TEST_F(PolicyComparisonTest, HalvesInTurnAreAlternatingAndAlwaysTheSameOrderIsNot) {
  const auto write = [&](const char* file, bool in_turn) {
    TestExperiment experiment(path(file), 6);
    for (std::uint32_t match = 0; match < 6; ++match) {
      experiment.begin();
      const bool turned = in_turn && match % 2 == 1;
      experiment.session(match, 0, "", {{1, turned ? "moving" : "stopped"}, {2, turned ? "stopped" : "moving"}}, false);
      for (const std::int64_t half : {1, 2}) {
        const char* const policy = (half == 1) == turned ? "moving" : "stopped";
        for (std::int64_t i = 1; i <= 8; ++i) experiment.possession(half, i, policy, 1.0, i % 2 == 0 ? kIn : kOut);
      }
      experiment.commit();
    }
    experiment.finish();
  };
  write("turns.db", true);
  write("order.db", false);
  EXPECT_EQ(compared({}, {"turns.db"}).pairs[0].design, Design::kAlternating);
  const auto ordered = compared({}, {"order.db"});
  EXPECT_EQ(ordered.pairs[0].design, Design::kBeforeAfter);
  EXPECT_THAT(to_text(ordered), HasSubstr("always in the same order of halves"));
  EXPECT_THAT(to_text(ordered), Not(HasSubstr("because of")));
}

TEST_F(PolicyComparisonTest, ARecordedMatchOfKicksAloneIsComparedByItsKicks) {
  {
    auto real = session();
    real.simulated = false;
    real.seed.reset();
    MatchLog match(path(), real, options());
    write_table2(match);
    const auto refused = match.decide(1);
    match.order(refused);
    match.receipt(refused, "stale");
    match.close();
  }
  const auto result = compared();
  EXPECT_EQ(result.groups[0].name, "stopped");
  EXPECT_EQ(result.groups[0].inside(), 34);
  EXPECT_EQ(result.groups[0].outside(), 31);
  EXPECT_EQ(result.groups[1].kicks(), 132) << "a refused order is no kick";
  EXPECT_EQ(result.groups[0].opportunities, 0);
  EXPECT_NEAR(result.pairs[0].headline->ci.lo, 0.0931659315, 1e-9);
  EXPECT_THAT(to_text(result), HasSubstr("moving differs from stopped"));
  EXPECT_THAT(to_text(result), Not(HasSubstr("SIMULATED")));
  EXPECT_THAT(message_of({.truth = true}), HasSubstr("none of these matches was simulated"));
  for (const std::string by : {"table", "arm"}) {
    EXPECT_EQ(message_of({.by = by}),
              "by " + by + ": no session of these logs names its " + by + "; those of trivela simulate do");
  }
}

// The interval of the pair alone is clear of 0; of as many comparisons one like it comes by chance.
TEST_F(PolicyComparisonTest, AmongSeveralGroupsTheVerdictIsHolms) {
  const auto dataset_of = [](const std::vector<int>& inside_of_40) {
    KickDataset dataset;
    for (std::uint32_t group = 0; group < inside_of_40.size(); ++group) {
      dataset.groups.push_back(std::string(1, static_cast<char>('a' + group)));
      for (int i = 0; i < 40; ++i)
        dataset.opportunities.push_back(
            {.group = group, .ending = i < inside_of_40[group] ? Ending::kInside : Ending::kOutside});
    }
    return dataset;
  };
  const auto alone = compare_policies(dataset_of({16, 26}), "policy");
  EXPECT_LT(alone.pairs[0].headline->p_holm, 0.05);
  EXPECT_EQ(alone.pairs[0].headline->verdict, stats::Verdict::kBetterMaybeTooSmall);
  const auto one_of_three = compare_policies(dataset_of({16, 26, 17, 18}), "policy");
  EXPECT_GT(one_of_three.pairs[0].headline->ci.lo, 0.0);
  EXPECT_GT(one_of_three.pairs[0].headline->p_holm, 0.05);
  EXPECT_EQ(one_of_three.pairs[0].headline->verdict, stats::Verdict::kNotEnoughData);
}

TEST_F(PolicyComparisonTest, TheSameLogTwiceCountsOnce) {
  write_paired(6);
  std::filesystem::copy_file(path(), path("copy.db"));
  const auto result = compared({}, {"match.db", "copy.db"});
  EXPECT_EQ(result.groups[0].opportunities, 60);
  EXPECT_THAT(to_text(result), HasSubstr("stand in an earlier log, too, and count once"));
}

/// Ten kicks on target in each half, of which the rule allows no goal of four in the first, as seen and in truth.
class RulesOfGoals : public PolicyComparisonTest {
 protected:
  using Int = MatchLog::Int;

  void expect_four_no_goals(const std::string& rule,
                            const std::function<void(MatchLog&, Int half, bool allowed)>& place,
                            const std::string& said) {
    log::Session ruled = session();
    ruled.config_toml = "### settings\n[rules]\n" + rule + "\n\n### robot\nball_offset_m = 0.27\n";
    MatchLog match(path(), ruled, options());
    for (const Int half : {1, 2}) {
      for (int kick = 0; kick < 10; ++kick) {
        place(match, half, half == 2 || kick >= 4);
        match.truth(match.kick(half, "on_target"), "on_target");
      }
    }
    match.close();
    for (const bool truth : {false, true}) {
      const auto result = compared({.truth = truth});
      EXPECT_EQ(result.groups[0].inside(), 6) << truth;
      EXPECT_EQ(result.groups[1].inside(), 10) << truth;
      EXPECT_THAT(to_text(result), HasSubstr("4 kicks on target " + said + " are outside")) << truth;
    }
  }
};

TEST_F(RulesOfGoals, ABallFromTheOwnHalfIsNoGoalAsSeenOrInTruth) {
  expect_four_no_goals(
      "opponents_half_only = true", [](MatchLog& match, Int, bool allowed) { match.y_m = allowed ? 3.0 : -1.0; },
      "from the own half");
}

TEST_F(RulesOfGoals, ABallThatWasCarriedTooFarIsNoGoalAsSeenOrInTruth) {
  expect_four_no_goals(
      "carry_limit_m = 3.0",
      [](MatchLog& match, Int half, bool allowed) {
        match.y_m = allowed ? 3.0 : 0.5;
        match.hold(half);
        match.y_m = 4.0;
      },
      "after the ball was carried too far");
}

TEST_F(PolicyComparisonTest, LogsWithoutKicksGiveASentence) {
  {
    MatchLog match(path(), session(), options());
    match.close();
  }
  EXPECT_THAT(message_of(), HasSubstr("there are no kicks"));
  TestExperiment experiment(path("idle.db"), 1);
  experiment.begin();
  experiment.session(0, 0, "a", {{1, "moving"}});
  experiment.possession(1, 1, "moving", 1.0, std::nullopt);
  experiment.session(0, 1, "b", {{1, "moving"}});
  experiment.possession(1, 1, "moving", 1.0, std::nullopt);
  experiment.commit();
  experiment.finish();
  try {
    compared({}, {"idle.db"});
    ADD_FAILURE() << "no kick";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("2 opportunities but no kick"));
  }
}

TEST_F(PolicyComparisonTest, AnArmThatNeverKicksIsComparedByItsOpportunities) {
  TestExperiment experiment(path(), 6);
  for (std::uint32_t match = 0; match < 6; ++match) {
    experiment.begin();
    experiment.session(match, 0, "idle", {{1, "stopped"}});
    for (std::int64_t i = 1; i <= 5; ++i) experiment.possession(1, i, "stopped", 1.0, std::nullopt);
    experiment.session(match, 1, "busy", {{1, "moving"}});
    for (std::int64_t i = 1; i <= 5; ++i) experiment.possession(1, i, "moving", 1.0, i < 4 ? kIn : kOut);
    experiment.commit();
  }
  experiment.finish();
  const auto result = compared();
  EXPECT_FALSE(result.pairs[0].efficiency);
  EXPECT_NEAR(result.pairs[0].headline->difference, 0.6, 1e-12);
  EXPECT_THAT(to_text(result), HasSubstr("busy is better than idle"));
  EXPECT_THAT(to_json(result), HasSubstr("\"efficiency\": null"));
}

}  // namespace
}  // namespace trivela::evaluator
