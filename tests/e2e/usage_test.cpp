// What `trivela match` says to bad usage.
#include <gmock/gmock.h>

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

}  // namespace
}  // namespace trivela::e2e
