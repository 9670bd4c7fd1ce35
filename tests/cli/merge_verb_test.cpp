#include <gmock/gmock.h>

#include <csignal>
#include <fstream>
#include <utility>

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
    log::Session session = LogTest::session();
    session.robot_id = robot_id;
    session.simulated_clock = session.simulated = false;
    session.seed.reset();
    evaluator::MatchLog match(path(name), session, options());
    match.robot_id = robot_id;
    match.kicks(1, "on_target", robot_id);
    match.close();
    return path(name);
  }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory_))
      names.push_back(entry.path().filename().string());
    return names;
  }

  int exit_code_ = -1;
};

/// SIGINT waits for whoever takes it, as if Ctrl-C had been pressed a moment ago.
class PressedCtrlC {
 public:
  PressedCtrlC() {
    sigset_t interrupt;
    sigemptyset(&interrupt);
    sigaddset(&interrupt, SIGINT);
    sigprocmask(SIG_BLOCK, &interrupt, &before_);
    raise(SIGINT);
  }
  PressedCtrlC(const PressedCtrlC&) = delete;
  PressedCtrlC& operator=(const PressedCtrlC&) = delete;
  ~PressedCtrlC() { sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

TEST_F(MergeVerb, PrintsTheFilesAndThatNothingIsMissing) {
  const std::string text = said({path("out.db"), robot_log("one.db", 1), robot_log("two.db", 2)});
  EXPECT_THAT(text,
              AllOf(HasSubstr("2 sessions of robot 1, robot 2"), HasSubstr("3 kicks"), EndsWith("missing: nothing\n")));
  EXPECT_EQ(exit_code_, kDone);
}

TEST_F(MergeVerb, EndsWithWhatIsMissingAndItsExitCode) {
  const std::string cut = robot_log("cut.db", 2);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  EXPECT_THAT(said({path("out.db"), robot_log("one.db", 1), cut}), HasSubstr("cut.db"));
  EXPECT_EQ(exit_code_, kDoneWithLoss);
}

TEST_F(MergeVerb, RefusesWhatIsNoMatchLogAndWritesNothing) {
  const std::string one = robot_log("one.db", 1);
  std::filesystem::create_directory(path("folder"));
  std::ofstream{path("empty.db")}.close();
  std::ofstream{path("text.db")} << "kick, outcome\n1, goal\n";
  for (const auto& [name, says] :
       std::vector<std::pair<std::string, std::string>>{{"nowhere.db", "there is no match log"},
                                                        {"folder", "is a folder"},
                                                        {"empty.db", "is empty"},
                                                        {"text.db", "is not a match log"}}) {
    try {
      said({path("out.db"), path(name), one});
      FAIL() << name;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(name), HasSubstr(says)));
    }
    EXPECT_FALSE(std::filesystem::exists(path("out.db"))) << name;
  }
}

TEST_F(MergeVerb, LeavesNothingWhereItIsStopped) {
  const std::string one = robot_log("one.db", 1), two = robot_log("two.db", 2);
  const PressedCtrlC now;
  const VerbRun run = run_verbs({add_merge}, {"merge", path("out.db"), one, two});
  EXPECT_EQ(run.exit_code, kFailed);
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.errors, HasSubstr("interrupted: there is no " + path("out.db").string()));
  EXPECT_THAT(files(), testing::UnorderedElementsAre("one.db", "two.db"));
}

TEST_F(MergeVerb, NeverWritesOverAFileThatIsThere) {
  const std::string one = robot_log("one.db", 1), two = robot_log("two.db", 2);
  const auto size = std::filesystem::file_size(one);
  EXPECT_THROW(said({one, two}), config::BadArgument);
  EXPECT_EQ(std::filesystem::file_size(one), size);
}

TEST_F(MergeVerb, SaysWhereNoClockWasMeasuredAgainstTheRobotThatIsNamed) {
  const std::string one = robot_log("one.db", 1), two = robot_log("two.db", 2);
  const VerbRun run = run_verbs({add_merge}, {"merge", path("out.db"), one, two, "--reference", "7"});
  EXPECT_EQ(run.exit_code, kDone);
  EXPECT_THAT(run.errors, HasSubstr("no clock was measured against that of robot 7"));
  EXPECT_EQ(run_verbs({add_merge}, {"merge", path("none.db"), one, two}).errors, "") << "nobody asked";
}

TEST_F(MergeVerb, ThatTwoFilesSayDifferentThingsOfAKickIsAnExitCode) {
  log::Session played = LogTest::session();
  played.uuid = "0123abcd-0000-4000-8000-000000000001";
  for (const auto& [name, label] : {std::pair{"a.db", "goal"}, std::pair{"b.db", "saved"}}) {
    evaluator::MatchLog match(path(name), played, options());
    match.kicks(1, "on_target", 2);
    match.close();
    run_verbs({add_label}, {"label", path(name), "1:1", label, "--by", "Ada"});
  }
  EXPECT_THAT(
      said({path("out.db"), path("a.db"), path("b.db")}),
      AllOf(HasSubstr("conflicts, of which the more complete recording counts"), EndsWith("missing: nothing\n")));
  EXPECT_EQ(exit_code_, kDoneWithLoss);
  std::filesystem::copy_file(path("a.db"), path("copy.db"));
  said({path("same.db"), path("a.db"), path("copy.db")});
  EXPECT_EQ(exit_code_, kDone) << "the same said twice is no conflict";
}

}  // namespace
}  // namespace trivela::cli
