// What `trivela` says to bad usage and to a full disk.
#include <gmock/gmock.h>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/e2e/folder.hpp"
#include "tests/e2e/program.hpp"

namespace trivela::e2e {
namespace {

using testing::HasSubstr;

struct Mistake {
  std::string name;
  std::vector<std::string> arguments;
  int exit_code;
  std::string says;
};

class Usage : public testing::TestWithParam<Mistake> {};

TEST_P(Usage, IsRefusedInOneSentenceAndLeavesNothing) {
  const Mistake& mistake = GetParam();
  const Folder folder;
  std::vector<std::string> arguments{"match"};
  arguments.insert(arguments.end(), mistake.arguments.begin(), mistake.arguments.end());
  Program match{"trivela", arguments, folder.path()};
  EXPECT_EQ(match.wait(), mistake.exit_code);
  EXPECT_THAT(match.errors(), HasSubstr(mistake.says));
  EXPECT_EQ(match.output(), "");
  EXPECT_THAT(folder.files(""), testing::UnorderedElementsAre("trivela.0.out", "trivela.0.err"));
}

INSTANTIATE_TEST_SUITE_P(
    Match, Usage,
    testing::Values(
        Mistake{"UnknownPolicy", {"--half", "dancing"}, 2, "dancing"},
        Mistake{"NoHalf", {}, 2, "--half or --random is required"},
        Mistake{"NoMinutes", {"--half", "moving", "--minutes", "0"}, 2, "--minutes: 0 is not"},
        Mistake{"NanMinutes", {"--half", "moving", "--minutes", "nan"}, 2, "--minutes: nan is not"},
        Mistake{"WordMinutes", {"--half", "moving", "--minutes", "five"}, 2, "--minutes: five is not"},
        Mistake{"NegativeSeed", {"--half", "moving", "--seed", "-3"}, 2, "-3"},
        Mistake{"DomainTooHigh", {"--half", "moving", "--domain", "101"}, 2, "101"},
        Mistake{"UnknownLogLevel", {"--half", "moving", "--log-level", "loud"}, 2, "loud"},
        Mistake{"UnknownFlag", {"--half", "moving", "--halves", "2"}, 2, "--halves"},
        Mistake{"MissingFolder", {"--half", "moving", "--out", "no/such/folder.db"}, 1, "--out no/such/folder.db"},
        Mistake{"UnwritableOut", {"--half", "moving", "--out", "/proc/match.db"}, 1, "--out /proc/match.db"},
        Mistake{"OutIsAFolder", {"--half", "moving", "--out", "."}, 2, "--out . exists"},
        Mistake{"MissingConfig", {"--half", "moving", "--config", "nope.toml"}, 1, "nope.toml"},
        Mistake{"UnknownKey", {"--half", "moving", "--set", "policy.settle=3"}, 1, "policy.settle: unknown key"},
        Mistake{"ImpossibleValue", {"--half", "moving", "--set", "policy.settle_s=-3"}, 1, "policy.settle_s = -3"},
        Mistake{"MissingRobot", {"--half", "moving", "--set", "run.robot=\"no_one.toml\""}, 1, "no_one.toml"}),
    [](const auto& test) { return test.param.name; });

TEST(Usage, ARecordedMatchIsNeverOverwritten) {
  const Folder folder;
  std::ofstream{folder / "match.db"} << "a match";
  Program match{"trivela", {"match", "--half", "moving", "--out", "match.db"}, folder.path()};
  EXPECT_EQ(match.wait(), 2);
  EXPECT_THAT(match.errors(), HasSubstr("--out match.db exists already"));
  EXPECT_EQ(text_of(folder / "match.db"), "a match");
}

struct BadNumber {
  std::vector<std::string> arguments;
  std::string says;
};

TEST(Usage, NumbersThatAreNoneAreRefusedWithFlagAndValue) {
  const Folder folder;
  for (const auto& [arguments, says] : std::vector<BadNumber>{
           {{"compare", "--counts", "a=1/2", "b=1/2", "--smallest-effect", "nan"}, "--smallest-effect: nan is not"},
           {{"compare", "--counts", "a=1/2", "b=1/2", "--smallest-effect", "inf"}, "--smallest-effect: inf is not"},
           {{"factorial", "--opponent-median", "1,nan"}, "--opponent-median: nan is not"},
           {{"frontier", "--threshold", "nan"}, "--threshold: nan is not"},
           {{"factorial", "--seed", "-1"}, "--seed: Value -1 not in range"},
           {{"frontier", "--seed", "-1"}, "--seed: Value -1 not in range"},
           {{"sensitivity", "--input", "kicker.delay_s,kicker.delay_s"}, "\"kicker.delay_s\" stands twice"},
           {{"sensitivity", "--seed", "-1"}, "--seed: Value -1 not in range"}}) {
    Program trivela{"trivela", arguments, folder.path()};
    EXPECT_EQ(trivela.wait(), 2) << says;
    EXPECT_THAT(trivela.errors(), HasSubstr(says));
    EXPECT_EQ(trivela.output(), "");
  }
}

TEST(Usage, AFullDiskIsSaid) {
  const Folder folder;
  std::ofstream{folder / "kicks.csv"} << "policy,on_target\na,1\nb,0\n";
  const auto tests = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::string program = (tests.parent_path() / "trivela").string();
  for (const std::string verb : {"compare --csv kicks.csv", "compare --csv kicks.csv --json", "--help",
                                 "frontier --matches 2 --possessions 1 --threshold 0.5", "solve --help"}) {
    const std::string command = "cd " + folder.path().string() + " && " + program + " " + verb;
    const int status = std::system((command + " > /dev/full 2> said").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << verb;
    EXPECT_EQ(text_of(folder / "said"), "trivela: cannot write the output: No space left on device\n") << verb;
  }
}

}  // namespace
}  // namespace trivela::e2e
