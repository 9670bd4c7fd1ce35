// Each kick counts once: recordings of one match, replays, matches played again, paired halves.
#include "evaluator/sessions/same_match.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/counting/log_kicks.hpp"
#include "evaluator/table2/table2.hpp"
#include "kicking/geometry/time.hpp"
#include "tests/evaluator/experiment_fixture.hpp"
#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/merged_log.hpp"
#include "tests/evaluator/report_of_log.hpp"

namespace trivela::evaluator {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class OnePlay : public LogTest {
 protected:
  /// A recording on robots that began at `started_s` of their common clock and lasted ten minutes.
  static log::Session recording(double started_s = 0.0) {
    auto real = session();
    real.simulated = real.simulated_clock = false;
    real.seed.reset();
    real.started_t_ns = kicking::nanoseconds(started_s);
    real.realtime_offset_ns = 1'000'000'000'000'000'000;
    return real;
  }

  LoggedOpportunities read(const std::vector<std::string>& names) const {
    std::vector<std::filesystem::path> logs;
    for (const std::string& name : names) logs.push_back(path(name));
    return read_opportunities(logs, false);
  }

  PolicyComparison compared(const std::vector<std::string>& names) const {
    std::vector<std::filesystem::path> logs;
    for (const std::string& name : names) logs.push_back(path(name));
    std::string by;
    KickDataset dataset = read_log_kicks(logs, {}, by);
    return compare_policies(std::move(dataset), by);
  }

  void write(const std::string& name, const log::Session& of, const std::function<void(MatchLog&)>& rows) {
    MatchLog match(path(name), of, options());
    rows(match);
    match.close();
  }
};

TEST_F(OnePlay, TwoRecordersOfOneMatchGiveTheNumbersOfOne) {
  write("one.db", recording(), write_table2);
  write("two.db", recording(), write_table2);
  const auto one = compared({"one.db"}), both = compared({"one.db", "two.db"});
  EXPECT_EQ(both.groups[0].inside(), 34);
  EXPECT_EQ(both.groups[1].outside(), 32);
  EXPECT_EQ(both.groups[0].matches, 1u);
  EXPECT_EQ(both.pairs[0].headline->ci.lo, one.pairs[0].headline->ci.lo);
  EXPECT_EQ(both.pairs[0].headline->ci.hi, one.pairs[0].headline->ci.hi);
  EXPECT_THAT(both.dataset.remarks,
              Contains(HasSubstr("197 of its kicks stand in another recording of the same match")));
}

TEST_F(OnePlay, TheRecordingThatKnowsMoreOfAKickSpeaks) {
  write("killed.db", recording(), [](MatchLog& match) {
    for (int i = 0; i < 3; ++i) match.referee(0.1 * i, 1, true);
    match.kick(1, "over");
    const auto kick = match.decide(1);
    match.order(kick);
    match.receipt(kick);
  });
  write("whole.db", recording(), [](MatchLog& match) {
    for (int i = 0; i < 3; ++i) match.referee(0.1 * i, 1, true);
    match.kick(1, "over");
    match.kick(1, "on_target");
  });
  for (const auto& order : {std::vector<std::string>{"killed.db", "whole.db"}, {"whole.db", "killed.db"}}) {
    const auto logged = read(order);
    ASSERT_EQ(logged.rows.size(), 2u);
    EXPECT_EQ(logged.rows[0].ending == Ending::kInside, logged.rows[1].ending == Ending::kOutside);
    EXPECT_NE(logged.rows[0].ending, Ending::kUnknown);
    EXPECT_NE(logged.rows[1].ending, Ending::kUnknown);
  }
}

TEST_F(OnePlay, RecordersOfFiveRobotsCountTheKicksOfEachOnce) {
  std::vector<std::string> names;
  for (int recorder = 1; recorder <= 5; ++recorder) {
    names.push_back("robot_" + std::to_string(recorder) + ".db");
    auto of = recording(0.001 * recorder);
    of.robot_id = recorder;
    write(names.back(), of, [](MatchLog& match) {
      for (int robot = 1; robot <= 5; ++robot) {
        match.robot_id = robot;
        match.kick(1, "on_target");
        match.kick(2, "over");
      }
    });
  }
  EXPECT_EQ(read(names).rows.size(), 10u);
  EXPECT_EQ(read(names).matches, 1u);
}

TEST_F(OnePlay, MatchesOfOtherRobotsAtTheSameTimeAreBothCounted) {
  write("field_a.db", recording(), [](MatchLog& match) { match.kicks(1, "over", 3); });
  write("field_b.db", recording(), [](MatchLog& match) {
    match.status(0, 0);  // its kicks have other instants
    match.kicks(1, "over", 3);
  });
  EXPECT_EQ(read({"field_a.db", "field_b.db"}).rows.size(), 6u);
}

TEST_F(OnePlay, TheMinutesOfTwoRecordingsAreThoseOfTheMatch) {
  const auto whole = [](MatchLog& match) {
    match.kicks(1, "over", 4);
    match.referee(0.0, 1, true);
    match.referee(120.0, 1, false);
  };
  const auto late = [](MatchLog& match) {
    match.kicks(1, "over", 4);
    match.referee(60.0, 1, true);
    match.referee(120.0, 1, false);
  };
  write("whole.db", recording(), whole);
  write("late.db", recording(), late);
  double minutes = 0.0;
  for (const PlayedSpan& span : read({"late.db", "whole.db"}).spans) minutes += span.minutes;
  EXPECT_NEAR(minutes, 2.0, 1e-9);
}

TEST_F(OnePlay, AReplayIsLeftOutAndShownAlone) {
  write("match.db", session(), write_table2);
  auto replay = session();
  replay.seed.reset();
  replay.scenario = "replay of match.db";
  replay.replays_uuid = "11111111-2222-4333-8444-555555555555";
  write("again.db", replay, [](MatchLog& match) { match.kicks(2, "over", 40); });
  const auto both = compared({"match.db", "again.db"});
  EXPECT_EQ(both.groups[1].outside(), 32);
  EXPECT_THAT(both.dataset.remarks, Contains(HasSubstr("again.db: 1 of its sessions replays another one")));
  const Report alone = make_report(log::Reader(path("again.db")));
  EXPECT_EQ(alone.policies[1].kicks() + alone.policies[0].kicks(), 40);
  EXPECT_THAT(to_text(alone), AllOf(HasSubstr("is a replay of match.db"), Not(HasSubstr("How sure"))));
  EXPECT_THROW(read({"again.db"}), std::runtime_error);
}

TEST_F(OnePlay, AMatchThatWasPlayedAgainInLockstepCountsOnceTheWholeOneOfTheTwo) {
  write("short.db", session(), [](MatchLog& match) {
    match.status(0, 0);
    match.kicks(1, "over", 2);
  });
  write("whole.db", session(), [](MatchLog& match) { match.kicks(1, "over", 5); });
  for (const auto& order : {std::vector<std::string>{"short.db", "whole.db"}, {"whole.db", "short.db"}})
    EXPECT_EQ(read(order).rows.size(), 5u) << order.front();
}

TEST_F(OnePlay, AHalfThatTwoMatchesHaveAlikeCountsOnce) {
  const auto of = [](double half_minutes, const char* second) {
    auto match = session();
    match.config_toml =
        fmt::format("### settings\npolicy_by_half = [\"stopped\", \"{}\"]\nhalf_minutes = {}\n### scenario\n", second,
                    half_minutes);
    match.policies = {{1, "stopped"}, {2, second}};
    return match;
  };
  const auto rows = [](MatchLog& match) {
    match.kicks(1, "over", 5);
    match.kicks(2, "on_target", 4);
  };
  write("match.db", of(5, "moving"), rows);
  write("longer.db", of(6, "moving"), [&](MatchLog& match) {
    match.status(0, 0);  // another program numbers its kicks otherwise: here their instants differ
    rows(match);
    match.kicks(2, "over", 2);
  });
  write("other.db", of(5, "predictive"), [&](MatchLog& match) {
    match.status(0, 0);
    match.status(0, 0);
    rows(match);
  });
  EXPECT_EQ(read({"match.db", "longer.db"}).rows.size(), 11u) << "the longer one holds the other";
  EXPECT_EQ(read({"longer.db", "match.db"}).rows.size(), 11u);
  write("second_recorder.db", of(5, "moving"), rows);
  EXPECT_EQ(read({"match.db", "second_recorder.db", "longer.db"}).rows.size(), 11u) << "nor does another recording";
  const auto both = read({"match.db", "other.db"});
  EXPECT_EQ(both.rows.size(), 13u) << "the first half is the same, the second of another policy";
  EXPECT_THAT(both.remarks, Contains(HasSubstr("1 of its halves was played before with the same seed")));
  auto other_seed = of(5, "predictive");
  other_seed.seed = 8;
  write("seed.db", other_seed, rows);
  EXPECT_EQ(read({"match.db", "seed.db"}).rows.size(), 18u);
}

TEST_F(OnePlay, ReportOfAMergedFileCountsOnceToo) {
  write("one.db", recording(), write_table2);
  write("match.db", recording(), write_table2);
  merge(path("one.db"), path());
  const Report report = make_report(log::Reader(path()));
  ASSERT_EQ(report.policies.size(), 2u);
  EXPECT_EQ(report.policies[0].inside(), 34);
  EXPECT_EQ(report.policies[1].kicks(), 132);
  EXPECT_THAT(to_text(report), HasSubstr("197 of its kicks stand in another recording of the same match, too"));
}

class PairedHalves : public OnePlay {
 protected:
  // `second`: policy of the second half, which has the situations of the first; moving is on target where slow is not.
  void write_halves(const std::string& second, bool paired, std::int64_t possessions = 20) {
    TestExperiment match(path(), 1);
    match.paired_halves = paired;
    match.begin();
    match.session(0, 0, "", {{1, "moving"}, {2, second}}, false);
    for (const std::int64_t half : {1, 2}) {
      for (std::int64_t i = 1; i <= possessions; ++i)
        match.possession(half, i, half == 1 ? "moving" : second, 1.0,
                         LoggedKick{i % 4 == 0 ? "over" : "on_target", "over", 4.0});
    }
    match.commit();
    match.finish();
  }
};

TEST_F(PairedHalves, AreComparedAsPairs) {
  write_halves("stopped", true);
  const auto result = compared({"match.db"});
  EXPECT_EQ(result.pairs[0].design, Design::kPaired);
  EXPECT_THAT(result.dataset.design_reason, HasSubstr("the halves of each match have the same possessions"));
  ASSERT_TRUE(result.pairs[0].pairs);
  EXPECT_EQ(result.pairs[0].pairs->n(), 20);
  EXPECT_EQ(result.pairs[0].unpaired, 0);
  EXPECT_EQ(result.pairs[0].pairs->both, 15);
}

TEST_F(PairedHalves, OtherHalvesAreNot) {
  write_halves("stopped", false);
  EXPECT_EQ(compared({"match.db"}).pairs[0].design, Design::kBeforeAfter);
}

TEST_F(PairedHalves, OfOnePolicyAreNoMoreThanOneToTheReport) {
  write_halves("moving", true);
  const Report paired = make_report(log::Reader(path()));
  ASSERT_EQ(paired.policies.size(), 1u);
  EXPECT_EQ(paired.policies[0].counts().n, 40);
  EXPECT_EQ(paired.policies[0].repeated, 20);
  ASSERT_TRUE(paired.policies[0].paired_ci);
  const auto independent = stats::wilson(paired.policies[0].counts());
  const auto of_half = stats::wilson({15, 20});
  const auto ci = *paired.policies[0].paired_ci;
  EXPECT_GT(ci.hi - ci.lo, independent.hi - independent.lo);
  EXPECT_NEAR(ci.hi - ci.lo, of_half.hi - of_half.lo, 0.06) << "twenty situations, each of them twice alike";
  EXPECT_THAT(to_text(paired), HasSubstr("20 of the kicks of moving are in situations that it had in an earlier half"));
}

TEST_F(PairedHalves, OfItsOwnPossessionsNothingIsSaid) {
  write_halves("moving", false);
  const Report report = make_report(log::Reader(path()));
  EXPECT_EQ(report.policies[0].repeated, 0);
  EXPECT_THAT(to_text(report), Not(HasSubstr("earlier half")));
}

}  // namespace
}  // namespace trivela::evaluator
