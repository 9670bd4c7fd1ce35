#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "evaluator/counting/policy_order.hpp"
#include "evaluator/table2/report_parts.hpp"
#include "evaluator/table2/table2.hpp"
#include "tests/evaluator/experiment_fixture.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::evaluator {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

using Int = std::int64_t;

class ReportOfLogs : public LogTest {
 protected:
  Report reported(const std::vector<std::string>& names) const {
    std::vector<std::unique_ptr<log::Reader>> readers;
    std::vector<OpenLog> logs;
    for (const std::string& name : names) {
      readers.push_back(std::make_unique<log::Reader>(path(name)));
      logs.push_back({readers.back().get(), name});
    }
    return make_report(logs);
  }

  /// A match of robot 1 with so many kicks inside and outside, half 1 stopped.
  void write_match(const std::string& name, Int seed, int inside, int outside, const std::string& config = "a = 1\n") {
    log::Session played = session();
    played.uuid = fmt::format("{:08x}-0000-4000-8000-000000000001", seed);
    played.seed = seed;
    played.config_toml = config;
    MatchLog match(path(name), played, options());
    match.kicks(1, "on_target", inside);
    match.kicks(1, "over", outside);
    match.close();
  }

  /// Three matches of two arms, one opportunity in each, which arm `first` hits and the other does not.
  void write_experiment(const std::string& name, const std::string& run, const std::string& first,
                        const std::string& second, const std::string& config = "a = 1\n") {
    TestExperiment experiment(path(name), 3);
    experiment.run = run;
    experiment.config = config;
    for (std::uint32_t match = 0; match < 3; ++match) {
      experiment.begin();
      experiment.session(match, 0, first, {{1, "moving"}});
      experiment.possession(1, 1, "moving", 1.0, LoggedKick{});
      experiment.session(match, 1, second, {{1, "moving"}});
      experiment.possession(1, 1, "moving", 1.0, LoggedKick{.observed = "over", .truth = "over"});
      experiment.commit();
    }
    experiment.finish();
  }
};

TEST_F(ReportOfLogs, AddsUpTheKicksOfMatches) {
  write_match("a.db", 1, 3, 2);
  write_match("b.db", 2, 4, 1);
  const Report report = reported({"a.db", "b.db"});
  ASSERT_THAT(report.policies, SizeIs(2));
  EXPECT_EQ(report.policies[0].policy, "stopped");
  EXPECT_EQ(report.policies[0].inside(), 7);
  EXPECT_EQ(report.policies[0].outside(), 3);
  EXPECT_EQ(report.policies[1].kicks(), 0) << "moving was in charge of a half";
  EXPECT_THAT(report.sessions, SizeIs(2));
  EXPECT_THAT(report.not_counted, IsEmpty());
  EXPECT_THAT(to_text(report), HasSubstr("2 logs, each kick of which counts once"));
}

TEST_F(ReportOfLogs, CountsASessionThatStandsInTwoOfThemOnce) {
  write_match("a.db", 1, 3, 2);
  std::filesystem::copy_file(path("a.db"), path("copy.db"));
  const Report report = reported({"a.db", "copy.db"});
  EXPECT_EQ(report.policies[0].kicks(), 5);
  EXPECT_THAT(report.sessions, SizeIs(1));
  EXPECT_THAT(report.not_counted,
              ElementsAre("copy.db: 1 of its sessions stands in an earlier log, too, and counts once"));
  EXPECT_EQ(report.labels.kicks, 5) << "the labels' table, too";
}

TEST_F(ReportOfLogs, CountsLossesOfASessionThatStandsInTwoOfThemOnce) {
  MatchLog match(path("a.db"), session(), options());
  match.kicks(1, "on_target", 1);
  match.writer().add_loss("vision_frames", log::LossKind::kLost, 2);
  match.close();
  std::filesystem::copy_file(path("a.db"), path("copy.db"));
  EXPECT_EQ(reported({"a.db", "copy.db"}).rows_missing(), 2);
  EXPECT_THAT(reported({"a.db", "copy.db"}).warnings, testing::Contains("a.db: vision_frames: 2 rows are missing"));
}

TEST_F(ReportOfLogs, CountsAMatchThatWasPlayedAgainOnce) {
  write_match("a.db", 1, 3, 2);
  log::Session again = session();
  again.seed = 1;
  MatchLog match(path("again.db"), again, options());
  match.kicks(1, "on_target", 3);
  match.kicks(1, "over", 2);
  match.close();
  EXPECT_EQ(reported({"a.db", "again.db"}).policies[0].kicks(), 5);
}

TEST_F(ReportOfLogs, SaysWhatIsAddedUpThoughItDiffers) {
  write_match("a.db", 1, 3, 2);
  write_match("b.db", 2, 4, 1, "a = 2\n");
  EXPECT_THAT(reported({"a.db", "b.db"}).not_counted, ElementsAre("added up though played with 2 settings"));
}

TEST_F(ReportOfLogs, OfAnExperimentNamesArmsAndNotSessions) {
  write_experiment("e.db", "run", "moving", "moving paper");
  const Report report = reported({"e.db"});
  ASSERT_THAT(report.arms, SizeIs(2));
  EXPECT_EQ(report.arms[0].matches, 3);
  ASSERT_THAT(report.policies, SizeIs(2)) << "arms of one policy meet the same opportunities, and stand apart";
  EXPECT_EQ(report.policies[0].arm, "moving");
  EXPECT_EQ(report.policies[0].inside(), 3);
  EXPECT_EQ(report.policies[1].arm, "moving paper");
  EXPECT_EQ(report.policies[1].outside(), 3);
  const std::string text = to_text(report);
  EXPECT_THAT(text, AllOf(HasSubstr("Arm moving: scenario 'empty_field', 3 matches, half 1 moving, new table"),
                          HasSubstr("Arm moving paper: "), Not(HasSubstr("Session "))));
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_THAT(json["sessions"], IsEmpty());
  EXPECT_EQ(json["arms"][1]["arm"], "moving paper");
  EXPECT_EQ(json["arms"][1]["sessions"], 3);
}

TEST_F(ReportOfLogs, ArmsOfOneNameThatDifferStandApart) {
  write_experiment("e.db", "run", "moving", "other");
  write_experiment("f.db", "later", "moving", "other", "a = 2\n");
  const Report report = reported({"e.db", "f.db"});
  ASSERT_THAT(report.policies, SizeIs(4));
  EXPECT_EQ(report.policies[2].arm, "moving (2)");
  EXPECT_EQ(report.policies[2].kicks(), 3);
  EXPECT_THAT(report.not_counted,
              testing::Contains(AllOf(HasSubstr("the arm 'moving' was played with different settings"),
                                      HasSubstr("moving in e.db, moving (2) in f.db"))));
}

TEST_F(ReportOfLogs, ArmsOfOneNameThatAreAlikeAreAddedUp) {
  TestExperiment experiment(path("g.db"), 5);
  experiment.run = "more matches";
  for (std::uint32_t match = 3; match < 8; ++match) {
    experiment.begin();
    experiment.session(match, 0, "moving", {{1, "moving"}});
    experiment.possession(1, 1, "moving", 1.0, LoggedKick{});
    experiment.commit();
  }
  experiment.finish();
  write_experiment("e.db", "run", "moving", "other");
  const Report report = reported({"e.db", "g.db"});
  ASSERT_THAT(report.policies, SizeIs(2));
  EXPECT_EQ(report.policies[0].inside(), 8);
  EXPECT_EQ(report.arms[0].matches, 8);
}

TEST_F(ReportOfLogs, SaysThatAnExperimentIsNotFinished) {
  {
    TestExperiment experiment(path("e.db"), 2);
    experiment.begin();
    experiment.session(0, 0, "moving", {{1, "moving"}});
    experiment.possession(1, 1, "moving", 1.0, LoggedKick{});
    experiment.commit();
  }
  EXPECT_THAT(reported({"e.db"}).warnings,
              testing::Contains("the experiment is not finished, 1 of 2 matches are there"));
}

TEST_F(ReportOfLogs, HasATableByRobot) {
  log::Session both = session();
  both.robot_id = std::nullopt;
  MatchLog match(path("a.db"), both, options());
  match.kicks(1, "on_target", 2);
  match.robot_id = 2;
  match.kicks(1, "over", 3);
  match.kicks(2, "on_target", 1);
  match.close();
  const Report report = reported({"a.db"});
  ASSERT_THAT(report.robots, SizeIs(3));
  EXPECT_EQ(report.robots[0].robot_id, 1);
  EXPECT_EQ(report.robots[0].inside(), 2);
  EXPECT_EQ(report.robots[1].robot_id, 2);
  EXPECT_EQ(report.robots[1].policy, "stopped");
  EXPECT_EQ(report.robots[1].outside(), 3);
  EXPECT_EQ(report.robots[2].policy, "moving");
  EXPECT_EQ(report.robots[2].inside(), 1);
}

TEST_F(ReportOfLogs, NoTwoRowsHaveOneNameWhereAMatchIsBesideAnExperiment) {
  write_match("a.db", 1, 3, 2);
  write_experiment("e.db", "run", "stopped", "moving");
  std::vector<std::string> names;
  for (const PolicyRow& row : reported({"a.db", "e.db"}).policies) names.push_back(name_of(row));
  EXPECT_THAT(names, testing::UnorderedElementsAre("stopped (no arm)", "moving (no arm)", "stopped/moving", "moving"));
  EXPECT_EQ(name_of(reported({"a.db"}).policies.front()), "stopped") << "no arm is anywhere";
}

TEST_F(ReportOfLogs, PoliciesStandInTheOrderOfTheRegistry) {
  TestExperiment experiment(path("e.db"), 1);
  experiment.begin();
  experiment.session(0, 0, "", {});
  Int id = 0;
  for (const char* const policy : {"oracle", "learned", "predictive", "moving", "stopped"})
    experiment.possession(1, ++id, policy, 0.1, LoggedKick{});
  experiment.commit();
  experiment.finish();
  std::vector<std::string> names;
  for (const PolicyRow& row : reported({"e.db"}).policies) names.push_back(row.policy);
  EXPECT_THAT(names, ElementsAre("stopped", "moving", "predictive", "learned", "oracle"));
}

TEST(PolicyOrder, HasOldTablesBeforeNewOnesAndOtherNamesBehindByAlphabet) {
  std::vector<std::string> names = {"zebra", "new", "apple", "old", "moving", "stopped"};
  std::ranges::sort(names, PolicyOrder{});
  EXPECT_THAT(names, ElementsAre("stopped", "moving", "old", "new", "apple", "zebra"));
}

std::string last_line(const Report& report) {
  const std::string text = to_text(report);
  const std::size_t end = text.rfind('\n', text.size() - 2);
  return text.substr(end + 1, text.size() - end - 2);
}

TEST_F(ReportOfLogs, ItsLastLineIsTheComparisonToGoOnWith) {
  write_match("a.db", 1, 3, 2);
  write_match("b b.db", 2, 4, 1);
  write_experiment("e.db", "run", "moving", "other");
  EXPECT_EQ(last_line(reported({"a.db", "b b.db"})), "How sure is the difference: trivela compare a.db 'b b.db'");
  EXPECT_EQ(last_line(reported({"e.db"})), "How sure are the differences: trivela compare e.db --by arm");
  log::Session alone = session();
  alone.policies = {{1, "stopped"}};
  for (const char* const name : {"c.db", "d.db"}) {
    alone.seed = name[0];
    MatchLog match(path(name), alone, options());
    match.kicks(1, "on_target", 1);
    match.close();
  }
  EXPECT_EQ(last_line(reported({"c.db", "d.db"})),
            "How sure is the difference between the logs: trivela compare c.db d.db --by log");
  EXPECT_EQ(last_line(reported({"c.db"})), "To compare it with another log: trivela compare c.db OTHER.db");
}

TEST_F(ReportOfLogs, ASessionWithoutKicksHasNothingToCompare) {
  MatchLog(path("a.db"), session(), options()).close();
  EXPECT_EQ(next_comparison(reported({"a.db"})), "");
}

TEST(ShellWord, IsQuotedWhereAShellWouldTakeItApart) {
  EXPECT_EQ(shell_word("out/match-1.db"), "out/match-1.db");
  EXPECT_EQ(shell_word("$(rm a).db"), "'$(rm a).db'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("-rf"), "'-rf'");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace trivela::evaluator
