#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "cli/verbs.hpp"
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
  EXPECT_THAT(run("--csv").out, StartsWith("policy,"));
  EXPECT_EQ(run("--json").err, "");
}

TEST_F(ReportVerb, OfALogWithoutKicksIsDone) {
  evaluator::MatchLog(path(), session(), options()).close();
  EXPECT_EQ(run().exit_code, kDone);
}

TEST_F(ReportVerb, ReportsFirstAndThenSaysThatDataWereLost) {
  evaluator::MatchLog match(path(), session(), options());
  evaluator::write_table2(match);
  match.writer().add_loss("vision_frames", evaluator::log::LossKind::kLost, 2);
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

TEST_F(ReportVerb, TakesOneFormat) { EXPECT_THROW(run("--json --csv"), CLI::ParseError); }

}  // namespace
}  // namespace trivela::cli
