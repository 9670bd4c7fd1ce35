#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ReportVerb : public evaluator::LogTest {
 protected:
  struct Result {
    std::string out;
    std::string err;
    int exit_code = -1;
  };

  Result run(const std::string& flags = "") const {
    CLI::App app;
    Result result;
    add_report(app, result.exit_code);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    try {
      app.parse("report " + path().string() + " " + flags);
    } catch (...) {
      testing::internal::GetCapturedStdout();
      testing::internal::GetCapturedStderr();
      throw;
    }
    result.out = testing::internal::GetCapturedStdout();
    result.err = testing::internal::GetCapturedStderr();
    return result;
  }
};

TEST_F(ReportVerb, PrintsTable2AndIsDone) {
  evaluator::MatchLog match(path(), session(), options());
  evaluator::write_table2(match);
  match.close();
  EXPECT_EQ(run().exit_code, kDone);
  EXPECT_THAT(run().out, HasSubstr("52.3 %  40.4 % to 64.0 %"));
  EXPECT_THAT(run("--json").out, StartsWith("{"));
  EXPECT_THAT(run("--csv").out, StartsWith("row,arm,policy,"));
  EXPECT_THAT(run("--markdown").out, HasSubstr("| stopped | 34 | 31 | 0 | 52.3 % |"));
  EXPECT_THAT(run("--latex").out, HasSubstr("stopped & 34 & 31 & 0 & 52.3 \\% & "));
  EXPECT_EQ(run("--json").err, "");
}

TEST_F(ReportVerb, OfALogWithoutKicksIsDone) {
  evaluator::MatchLog(path(), session(), options()).close();
  EXPECT_EQ(run().exit_code, kDone);
}

TEST_F(ReportVerb, ReportsFirstAndThenSaysThatDataWereLost) {
  evaluator::MatchLog match(path(), session(), options());
  evaluator::write_table2(match);
  match.writer().add_loss("vision_frames", log::LossKind::kLost, 2);
  match.close();
  for (const char* const flags : {"", "--json", "--csv"}) {
    const Result result = run(flags);
    EXPECT_EQ(result.exit_code, kDoneWithLoss) << flags;
    EXPECT_THAT(result.out, HasSubstr("100")) << flags;
  }
  EXPECT_THAT(run("--csv").err, HasSubstr("vision_frames: 2 rows are missing"));
}

TEST_F(ReportVerb, OfALogThatWasChangedFailsWithAndWithoutVerify) {
  evaluator::MatchLog match(path(), session(), options());
  evaluator::write_table2(match);
  match.close();
  EXPECT_EQ(run("--verify").out, run().out);
  std::string bytes;
  {
    std::ifstream in(path(), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  const auto label = bytes.rfind("wide_left");
  ASSERT_NE(label, std::string::npos);
  bytes.replace(label, 9, "on_target");
  std::ofstream(path(), std::ios::binary) << bytes;
  for (const char* const flags : {"", "--verify", "--json", "--csv"})
    EXPECT_THROW(run(flags), std::runtime_error) << flags;
}

TEST_F(ReportVerb, FailsOnAFileThatIsNoLog) {
  EXPECT_THROW(run(), std::runtime_error);
  std::ofstream(path()) << "not a log at all, but long enough to be looked at";
  EXPECT_THROW(run(), std::runtime_error);
}

TEST_F(ReportVerb, TakesOneFormat) {
  for (const char* const two : {"--json --csv", "--markdown --latex", "--csv --latex"})
    EXPECT_THROW(run(two), CLI::ParseError) << two;
}

TEST_F(ReportVerb, WritesTheReportAndThenExitsByItsGates) {
  evaluator::MatchLog match(path(), session(), options());
  evaluator::write_table2(match);
  match.close();
  const Result met = run("--gate 'efficiency(moving)>=0.7' --gate missing_rows==0 --gate 'kicks(robot 1)==197'");
  EXPECT_EQ(met.exit_code, kDone) << met.out;
  EXPECT_THAT(met.out, HasSubstr("gate met: efficiency(moving)>=0.7: 0.757576"));
  EXPECT_EQ(met.err, "");
  for (const char* const form : {"", "--json ", "--csv ", "--markdown ", "--latex "}) {
    const Result missed = run(std::string(form) + "--gate 'efficiency(stopped)>=0.7' --gate missing_rows==0");
    EXPECT_EQ(missed.exit_code, kDoneWithLoss) << form;
    EXPECT_THAT(missed.out, HasSubstr("34")) << form;
    EXPECT_THAT(missed.err, HasSubstr("gate MISSED: efficiency(stopped)>=0.7: 0.523077")) << form;
  }
  EXPECT_EQ(run("--gate 'kicks_per_min(moving)<=99'").exit_code, kDoneWithLoss) << "no minutes, no rate";
}

TEST_F(ReportVerb, RefusesAGateThatCannotBeReadBeforeTheWork) {
  try {
    run("--gate 'efficiency(moving)=0.7'");  // of a log that is not there
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("--gate 'efficiency(moving)=0.7', character 19: one of >= <= > < == is missing"));
  }
}

TEST_F(ReportVerb, WritesToAFileThatItFindsWritableBeforeTheWork) {
  evaluator::MatchLog match(path(), session(), options());
  evaluator::write_table2(match);
  match.close();
  const std::string out = path("report.md").string();
  const Result written = run("--markdown --out " + out);
  EXPECT_EQ(written.out, "");
  std::ifstream in(out, std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), run("--markdown").out);
  std::filesystem::remove(path());
  try {
    run("--out " + path("nowhere/report.txt").string());
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot write --out")) << "not that there is no log";
  }
}

/// Two of three inside were goals when stopped, one of two when moving, and of one nobody says.
class ReportGoals : public ReportVerb {
 protected:
  ReportGoals() {
    {
      evaluator::MatchLog match(path(), session(), options());
      match.kicks(1, "on_target", 3);
      match.kicks(2, "on_target", 3);
      match.kicks(2, "over", 1);
      match.close();
    }
    const auto label = [&](const char* kick, const char* outcome) {
      run_verbs({add_label}, {"label", path().string(), kick, outcome, "--by", "Ada"});
    };
    label("1:1", "goal");
    label("1:2", "goal");
    label("1:3", "saved");
    label("1:4", "goal");
    label("1:5", "saved");
  }
};

TEST_F(ReportGoals, OfSeveralPoliciesAreAddedUpForAGateWithoutASubject) {
  EXPECT_EQ(run("--gate goals==3 --gate saved==2 --gate 'goals(all)==3' --gate inside==6").exit_code, kDone);
  EXPECT_EQ(run("--gate goals==2").exit_code, kDoneWithLoss) << "those of the first policy";
  EXPECT_EQ(run("--gate saved==1").exit_code, kDoneWithLoss);
}

TEST_F(ReportGoals, OfOnePolicyAreItsOwnForItsGate) {
  EXPECT_EQ(run("--gate 'goals(stopped)==2' --gate 'saved(stopped)==1' --gate 'goals(moving)==1' --gate "
                "'saved(moving)==1' --gate 'goals(moving, robot 1)==1'")
                .exit_code,
            kDone);
  const Result missed = run("--json --gate 'goals(moving)>=2'");
  EXPECT_EQ(missed.exit_code, kDoneWithLoss) << "a ball of which nobody says it is no goal";
  EXPECT_THAT(missed.err, HasSubstr("gate MISSED: goals(moving)>=2: 1"));
}

TEST_F(ReportGoals, AGateOfNobodyHasNoDataAndIsMissed) {
  for (const char* const nobody : {"goals(predictive)>=0", "saved(robot 2)>=0"}) {
    const Result missed = run(std::string("--gate '") + nobody + "'");
    EXPECT_EQ(missed.exit_code, kDoneWithLoss) << nobody;
    EXPECT_THAT(missed.err, HasSubstr("no data")) << nobody;
  }
}

}  // namespace
}  // namespace trivela::cli
