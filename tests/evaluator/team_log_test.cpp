// Logs of a team: minutes, sessions and designs by robot; how long was planned and recorded.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "evaluator/report/log_kicks.hpp"
#include "evaluator/report/policy_comparison.hpp"
#include "evaluator/report/table2.hpp"
#include "tests/evaluator/experiment_fixture.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::evaluator {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

class TeamLog : public LogTest {
 protected:
  // Robot 1 stopped, robot 2 moving; possessions in turn, those of robot 1 of half a minute, of robot 2 of a quarter.
  void write_team(bool noted, bool in_turn = false) {
    TestExperiment match(path(), 2);
    for (std::uint32_t id = 0; id < 2; ++id) {
      const auto policy = [&](std::int64_t robot) {
        return (robot == 1) != (in_turn && id == 1) ? "stopped" : "moving";
      };
      match.begin();
      match.session(id, 0, "", {{1, "learned", 0}, {1, policy(1), 1}, {1, policy(2), 2}, {1, "learned", 3}}, false);
      double at_s = 0.0;
      for (std::int64_t i = 1; i <= 8; ++i) {
        match.robot_id = 1 + i % 2;
        const double minutes = match.robot_id == 1 ? 0.5 : 0.25;
        match.played_possession(1, i, at_s, minutes);
        at_s += 60.0 * minutes;
        match.possession(1, i, policy(match.robot_id), noted ? 0.9999999 : 1.0,
                         i > 2 ? std::optional(LoggedKick{}) : std::nullopt);
      }
      match.commit();
    }
    match.finish();
  }
};

TEST_F(TeamLog, MinutesAreThoseOfTheRobotsOfAPolicy) {
  write_team(false);
  const Report report = make_report(log::Reader(path()));
  ASSERT_THAT(report.policies, SizeIs(2));
  EXPECT_EQ(report.policies[0].policy, "stopped");
  EXPECT_NEAR(*report.policies[0].played_min, 4.0, 1e-9);
  EXPECT_NEAR(*report.policies[1].played_min, 2.0, 1e-9);
  EXPECT_NEAR(*report.policies[1].kicks_per_min(), 3.0, 1e-9);
}

TEST_F(TeamLog, HasATableByRobotAndASessionLineThatIsTrue) {
  write_team(false);
  const Report report = make_report(log::Reader(path()));
  ASSERT_THAT(report.robots, SizeIs(2));
  EXPECT_EQ(report.robots[0].robot_id, 1);
  EXPECT_EQ(report.robots[0].policy, "stopped");
  EXPECT_EQ(report.robots[0].kicks(), 6);
  EXPECT_NEAR(*report.robots[0].played_min, 4.0, 1e-9);
  const std::string text = to_text(report);
  EXPECT_THAT(text, HasSubstr(", robot 1 stopped, robot 2 moving, version"));
  EXPECT_THAT(text, HasSubstr("By robot"));
  EXPECT_THAT(text, Not(HasSubstr("learned"))) << "of robots that nobody recorded";
  EXPECT_EQ(nlohmann::json::parse(to_json(report))["robots"][1]["robot_id"], 2);
}

TEST_F(TeamLog, ComparesWithTheMinutesOfTheReportAndSaysThatTheRobotsDiffer) {
  write_team(false);
  std::string by;
  const auto result = compare_policies(read_log_kicks({path()}, {}, by), by);
  EXPECT_NEAR(*result.groups[0].minutes, 4.0, 1e-9);
  EXPECT_NEAR(*result.groups[1].minutes, 2.0, 1e-9);
  EXPECT_EQ(result.pairs[0].design, Design::kBeforeAfter);
  EXPECT_THAT(result.book.design_reason,
              HasSubstr("side by side in the same matches, each robot always with the same"));
}

TEST_F(TeamLog, RobotsThatChangeRolesAlternate) {
  write_team(false, true);
  std::string by;
  const auto result = compare_policies(read_log_kicks({path()}, {}, by), by);
  EXPECT_EQ(result.pairs[0].design, Design::kAlternating);
  EXPECT_THAT(result.book.design_reason, HasSubstr("each robot played with each"));
}

TEST_F(TeamLog, ComparedByRobotEachHasItsMinutes) {
  write_team(false);
  std::string by;
  LogKicks options;
  options.by = "robot";
  const auto result = compare_policies(read_log_kicks({path()}, options, by), by);
  EXPECT_NEAR(*result.groups[0].minutes, 4.0, 1e-9);
  EXPECT_NEAR(*result.groups[1].minutes, 2.0, 1e-9);
}

class LengthOfALog : public LogTest {
 protected:
  Report report(double planned_s, double recorded_s, std::optional<double> second_half_from_s = {}) {
    auto planned = session();
    planned.planned_s = planned_s;
    planned.policies = {{1, "stopped"}};
    if (second_half_from_s) planned.policies.push_back({2, "moving"});
    MatchLog match(path(), planned, options());
    match.referee(0.0, 1, true);
    if (second_half_from_s) {
      match.referee(*second_half_from_s - 0.02, 1, true);
      match.referee(*second_half_from_s, 2, true);
    }
    match.referee(recorded_s, second_half_from_s ? 2 : 1, true);
    match.close();
    return make_report(log::Reader(path()));
  }
};

TEST_F(LengthOfALog, AMatchThatWasCutShortIsLoss) {
  const Report cut = report(300.0, 27.0);
  EXPECT_TRUE(cut.data_lost());
  EXPECT_THAT(to_text(cut), HasSubstr("Planned 300 s, recorded 27.0 s: CUT SHORT"));
  EXPECT_THAT(to_text(cut), HasSubstr("  cut short: 27.0 s of 300.0 s are recorded\n"));
  EXPECT_TRUE(nlohmann::json::parse(to_json(cut))["data_quality"]["lengths"][0]["cut_short"]);
}

TEST_F(LengthOfALog, AWholeOneIsNot) {
  const Report whole = report(300.0, 301.0);
  EXPECT_FALSE(whole.data_lost());
  EXPECT_THAT(to_text(whole), HasSubstr("Planned 300 s, recorded 301.0 s\n"));
}

TEST_F(LengthOfALog, HalvesThatOverranAreWhole) { EXPECT_FALSE(report(60.0, 66.0, 33.0).data_lost()); }

TEST_F(LengthOfALog, AHalfThatOverranMakesUpForNoneOfTheNext) {
  const Report cut = report(60.0, 61.0, 36.0);
  EXPECT_TRUE(cut.data_lost());
  EXPECT_THAT(to_text(cut), HasSubstr("Planned 60 s, recorded 61.0 s: CUT SHORT"));
}

TEST_F(LengthOfALog, AComparisonSaysThatAMatchWasCutShort) {
  report(300.0, 27.0);
  EXPECT_THAT(read_opportunities({path()}, false).remarks,
              testing::Contains(HasSubstr("match.db: cut short: 27.0 s of 300.0 s are recorded")));
}

TEST_F(LengthOfALog, WhereNobodyPlannedOneNothingIsSaid) {
  MatchLog match(path(), session(), options());
  match.referee(0.0, 1, true);
  match.referee(3.0, 1, true);
  match.close();
  const Report report = make_report(log::Reader(path()));
  EXPECT_FALSE(report.data_lost());
  EXPECT_THAT(to_text(report), Not(HasSubstr("Planned")));
}

TEST_F(LengthOfALog, TheValueOfAPolicySaysWhereDrawsHeldForAHalf) {
  TestExperiment match(path(), 1);
  match.begin();
  match.session(0, 0, "", {}, false);
  match.possession(1, 0, "moving", 0.5, LoggedKick{});
  match.commit();
  match.finish();
  const auto logged = read_opportunities({path()}, false);
  EXPECT_EQ(logged.draws_of_halves, 1);
}

}  // namespace
}  // namespace trivela::evaluator
