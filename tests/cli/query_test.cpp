#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class QueryVerb : public evaluator::LogTest {
 protected:
  QueryVerb() {
    evaluator::MatchLog match(path(), session(), options());
    match.kicks(1, "on_target", 2);
    match.kicks(2, "over", 1);
    match.close();
  }

  std::string said(std::vector<std::string> words) const {
    words.insert(words.begin(), "query");
    const VerbRun run = run_verbs({add_query}, words);
    EXPECT_EQ(run.exit_code, kDone);
    return run.out;
  }

  std::string refusal(std::vector<std::string> words) const {
    try {
      return said(std::move(words));
    } catch (const UsageError& error) {
      return error.what();
    }
  }
};

TEST_F(QueryVerb, AnswersAMetricAsTextCsvAndJson) {
  EXPECT_THAT(said({path(), "--metric", "outcomes_by_policy"}),
              AllOf(HasSubstr("  policy     outcome  kicks\n"), HasSubstr("  stopped  on_target      2\n")));
  EXPECT_EQ(said({path(), "--metric", "outcomes_by_policy", "--csv"}),
            "policy,outcome,kicks\nstopped,on_target,2\nmoving,over,1\n");
  const auto rows = nlohmann::json::parse(said({path(), "--metric", "outcomes_by_policy", "--json"}));
  EXPECT_EQ(rows, nlohmann::json::parse(R"([{"policy": "stopped", "outcome": "on_target", "kicks": 2},
                                            {"policy": "moving", "outcome": "over", "kicks": 1}])"));
}

TEST_F(QueryVerb, CountsAKickOfTwoRecordersOnceAsReportDoes) {
  auto recording = session();
  recording.simulated = recording.simulated_clock = false;
  recording.seed.reset();
  recording.realtime_offset_ns = 1'000'000'000'000'000'000;
  for (const char* const name : {"one.db", "two.db"}) {
    evaluator::MatchLog match(path(name), recording, options());
    match.kicks(1, "on_target", 3);
    match.close();
  }
  EXPECT_EQ(run_verbs({add_merge}, {"merge", path("both.db"), path("one.db"), path("two.db")}).exit_code, kDone);
  EXPECT_EQ(said({path("both.db"), "SELECT count(*) AS n FROM kicks", "--csv"}), "n\n6\n");
  EXPECT_EQ(said({path("both.db"), "--metric", "outcomes_by_policy", "--csv"}),
            "policy,outcome,kicks\nstopped,on_target,3\n");
}

TEST_F(QueryVerb, AnswersAQuestionOfOnesOwn) {
  const std::string sql = "SELECT 'a \"b\", c' AS text, NULL AS nobody, 0.25 AS quarter, x'00ff' AS bytes";
  EXPECT_EQ(said({path(), sql, "--csv"}), "text,nobody,quarter,bytes\n\"a \"\"b\"\", c\",,0.25,00ff\n");
  EXPECT_EQ(nlohmann::json::parse(said({path(), sql, "--json"})).at(0).at("nobody"), nullptr);
  std::ofstream(path("question.sql")) << "SELECT count(*) AS n FROM kicks;\n";
  EXPECT_EQ(said({path(), "-f", path("question.sql"), "--csv"}), "n\n3\n");
  EXPECT_EQ(said({path(), "SELECT 1 AS n WHERE 0", "--json"}), "[]\n");
}

TEST_F(QueryVerb, TwoColumnsOfOneNameAreNoJson) {
  EXPECT_THAT(refusal({path(), "select 1 as a, 2 as a", "--json"}), HasSubstr("two columns are called 'a'"));
  EXPECT_EQ(said({path(), "select 1 as a, 2 as a", "--csv"}), "a,a\n1,2\n");
}

TEST_F(QueryVerb, WhatATerminalCouldObeyIsWrittenOut) {
  const std::string sql = "SELECT char(27) || '[31m' || char(8238) AS red, '=1+1' AS formula, -1 AS number";
  EXPECT_THAT(said({path(), sql}), HasSubstr("\\x1b[31m"));
  EXPECT_EQ(said({path(), sql, "--csv"}), "red,formula,number\n\\x1b[31m\\xe2\\x80\\xae,'=1+1,-1\n");
  EXPECT_EQ(said({path(), sql, "--json"}),
            "[\n{\"red\":\"\\u001b[31m\\u202e\",\"formula\":\"=1+1\",\"number\":-1}\n]\n");
}

TEST_F(QueryVerb, ListsEachMetricWithItsColumns) {
  EXPECT_THAT(said({"--list"}),
              HasSubstr("refused_orders\n    Orders that the kicker's driver refused, by policy and "
                        "reason. not_known: it was killed while it wrote to the device, the kick "
                        "counts as one.\n    Columns: policy, refusal, orders, not_fired (of them, accepted "
                        "at first: a later receipt says that the coil was not energised).\n"));
}

TEST_F(QueryVerb, SaysWhatIsWrongWithTheQuestion) {
  EXPECT_THAT(refusal({path()}), HasSubstr("give one of SQL, --metric NAME and --file FILE"));
  EXPECT_THAT(refusal({path(), "SELECT 1", "--metric", "silences"}), HasSubstr("give one of"));
  EXPECT_THAT(refusal({path(), "--metric", "goals"}), HasSubstr("there is no metric 'goals'"));
  EXPECT_THAT(refusal({path(), "DROP TABLE referee"}), HasSubstr("cannot ask that: a log is only read"));
  EXPECT_THAT(refusal({}), HasSubstr("give a match log"));
}

}  // namespace
}  // namespace trivela::cli
