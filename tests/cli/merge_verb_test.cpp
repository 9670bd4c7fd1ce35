#include <gmock/gmock.h>

#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::cli {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

class MergeVerb : public evaluator::LogTest {
 protected:
  std::string said(std::vector<std::string> words) {
    words.insert(words.begin(), "merge");
    const VerbRun run = run_verbs({add_merge}, words);
    exit_code_ = run.exit_code;
    return run.out;
  }

  std::string robot_log(const std::string& name, int robot_id) {
    evaluator::log::Session session = LogTest::session();
    session.robot_id = robot_id;
    session.simulated_clock = session.simulated = false;
    session.seed.reset();
    evaluator::MatchLog match(path(name), session, options());
    match.robot_id = robot_id;
    match.kicks(1, "on_target", robot_id);
    match.close();
    return path(name);
  }

  int exit_code_ = -1;
};

TEST_F(MergeVerb, PrintsTheFilesAndThatNothingIsMissing) {
  const std::string text = said({path("out.db"), robot_log("one.db", 1), robot_log("two.db", 2)});
  EXPECT_THAT(text,
              AllOf(HasSubstr("2 sessions of robot 1, robot 2"), HasSubstr("3 kicks"), EndsWith("missing: nothing\n")));
  EXPECT_EQ(exit_code_, kDone);
}

TEST_F(MergeVerb, EndsWithWhatIsMissingAndItsExitCode) {
  EXPECT_THAT(said({path("out.db"), robot_log("one.db", 1), path("nowhere.db")}), HasSubstr("nowhere.db"));
  EXPECT_EQ(exit_code_, kDoneWithLoss);
}

}  // namespace
}  // namespace trivela::cli
