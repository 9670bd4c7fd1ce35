// `trivela team` as a user types it.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "cli/verbs.hpp"
#include "config/settings.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/support/folder.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class TeamVerb : public testing::Test {
 protected:
  TeamVerb() {
    fs::create_directory(folder / "teams");
    fs::copy(TRIVELA_SOURCE_DIR "/config/teams/example.toml", folder / "teams" / "team.toml");
    fs::create_directory_symlink(TRIVELA_SOURCE_DIR "/config/robots", folder / "robots");
  }

  /// The exit code; what was said in `said`. Throws what the program's main turns into a sentence.
  int run(std::vector<std::string> words) {
    words.insert(words.begin(), "team");
    const VerbRun run = run_verbs({add_team}, words);
    said = run.out + run.errors;
    return run.exit_code;
  }
  std::vector<std::string> configure(const std::string& more = "") const {
    std::vector<std::string> words{"configure", team(), "--robot", "2", "--out", (folder / "out").string()};
    if (!more.empty()) words.push_back(more);
    return words;
  }
  std::string team() const { return (folder / "teams" / "team.toml").string(); }
  std::string text(const std::string& name) const {
    std::ifstream in(folder / "out" / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  tests::Folder folder;
  std::string said;
};

TEST_F(TeamVerb, CheckShowsATeamThatIsWell) {
  EXPECT_EQ(run({"check", team()}), kDone);
  EXPECT_THAT(said, AllOf(HasSubstr("172.16.39.2"), HasSubstr("predictive"), HasSubstr("on the air, an estimate")));
}

TEST_F(TeamVerb, CheckSaysEverythingThatIsWrongWithItsLine) {
  std::ofstream(team(), std::ios::app) << "adress = \"172.16.39.101\"\n[[robot]]\nnumber = 2\naddress = \"10.0.0.1\"\n";
  EXPECT_THAT(
      [&] {
        run({"check", team()});
      },
      testing::ThrowsMessage<std::runtime_error>(
          AllOf(HasSubstr("team.toml:33: base.adress"), HasSubstr("address"), HasSubstr("10.0.0.1"))));
}

TEST_F(TeamVerb, CheckNamesARobotsNumberThatIsNone) {
  const std::string whole = [&] {
    std::ifstream in(team());
    return std::string{std::istreambuf_iterator<char>(in), {}};
  }();
  const std::string line = "[[robot]]\nnumber = 1\n";
  for (const char* const number :
       {"number = 0", "number = -1", "number = 256", "number = 1.5", "number = \"1\"", "number = true", ""}) {
    std::string text = whole;
    std::ofstream(team()) << text.replace(text.find(line), line.size(), std::string("[[robot]]\n") + number + "\n");
    for (const std::vector<std::string>& words : {std::vector<std::string>{"check", team()}, configure()})
      EXPECT_THAT([&] { run(words); }, testing::ThrowsMessage<std::runtime_error>(HasSubstr("number"))) << number;
  }
}

TEST_F(TeamVerb, ConfigureWritesOnceAndNeverOverWhatWasEdited) {
  EXPECT_EQ(run(configure()), kDone);
  EXPECT_THAT(said, AllOf(HasSubstr("settings.toml"), HasSubstr("team_bus.xml"), HasSubstr("robot.env"),
                          HasSubstr("trivela.target.conf")));
  EXPECT_EQ(config::load_settings(folder / "out" / "settings.toml").run.robot_id, 2U);
  EXPECT_EQ(run(configure()), kDone);
  EXPECT_THAT(said, HasSubstr("nothing to write"));
  const std::string env = text("robot.env");
  std::ofstream(folder / "out" / "robot.env", std::ios::app) << "TRIVELA_FLAGS_odometry=\"--realtime 60\"\n";
  const std::string edited = text("robot.env");
  EXPECT_EQ(run(configure()), kFailed);
  EXPECT_THAT(said, AllOf(HasSubstr("robot.env: edited by hand"), HasSubstr("--force")));
  EXPECT_EQ(text("robot.env"), edited);
  EXPECT_EQ(run(configure("--force")), kDone);
  EXPECT_EQ(text("robot.env"), env);
}

TEST_F(TeamVerb, ConfigureWantsOneMachineOfTheTeam) {
  EXPECT_THROW(run({"configure", team(), "--out", (folder / "out").string()}), UsageError);
  EXPECT_THROW(run(configure("--base")), UsageError);
  EXPECT_THROW(run({"configure", team(), "--robot", "9", "--out", (folder / "out").string()}), UsageError);
  EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
}  // namespace trivela::cli
