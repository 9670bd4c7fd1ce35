// What `trivela` says to bad usage and to a full disk.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

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
  const tests::Folder folder;
  std::vector<std::string> arguments{"match"};
  arguments.insert(arguments.end(), mistake.arguments.begin(), mistake.arguments.end());
  Program match{"trivela", arguments, folder.path()};
  EXPECT_EQ(match.wait(), mistake.exit_code);
  EXPECT_THAT(match.errors(), HasSubstr(mistake.says));
  EXPECT_LT(match.errors().size(), 350u) << "nobody reads more";
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
        Mistake{"NegativeSeed", {"--half", "moving", "--seed", "-3"}, 2, "--seed: Value -3 not in range"},
        Mistake{
            "SeedTooLarge", {"--half", "moving", "--seed", "9000000000000001"}, 2, "--seed: Value 9000000000000001"},
        Mistake{"ConfigIsAFolder",
                {"--half", "moving", "--config", "."},
                1,
                ".: cannot read the configuration: it is a folder"},
        Mistake{"ConfigNamesWhereItLooked", {"--half", "moving", "--config", "nope.toml"}, 1, "(in /"},
        Mistake{
            "LearnedWithoutAModel", {"--half", "learned"}, 1, "policy \"learned\" needs kick_decision.learned_model"},
        Mistake{"NoSuchModel",
                {"--half", "learned", "--set", "kick_decision.learned_model='none.toml'"},
                1,
                "none.toml: cannot read the configuration: No such file or directory (in /"},
        Mistake{"ChancesWithoutPolicies",
                {"--random", "stopped,moving", "--set", "kick_decision.random_probabilities=[0.5]"},
                1,
                "kick_decision.random_probabilities has 1 entries, kick_decision.random 2"},
        Mistake{"DrawnFromNobody",
                {"--random", "moving,bogus"},
                2,
                "--random: 'bogus' is no policy; there are stopped, moving, predictive, learned"},
        Mistake{"SeedSaidTwice",
                {"--half", "moving", "--seed", "3", "--set", "simulator.seed=5"},
                2,
                "--set simulator.seed=5: --seed says it"},
        Mistake{
            "AnotherCycle", {"--half", "moving", "--set", "run.cycle_s=0.03"}, 1, "differs from run.cycle_s = 0.03"},
        Mistake{"ATeamsWorld",
                {"--half", "moving", "--set", "run.scenario='" TRIVELA_SOURCE_DIR "/config/scenarios/team.toml'"},
                1,
                "one set of nodes is one robot"},
        Mistake{"DomainTooHigh", {"--half", "moving", "--domain", "101"}, 2, "101"},
        Mistake{"UnknownLogLevel", {"--half", "moving", "--log-level", "loud"}, 2, "loud"},
        Mistake{"UnknownFlag", {"--half", "moving", "--halves", "2"}, 2, "--halves"},
        Mistake{"MissingFolder",
                {"--half", "moving", "--out", "no/such/folder.db"},
                1,
                "--out no/such/folder.db: there is no folder no/such"},
        Mistake{"UnwritableOut", {"--half", "moving", "--out", "/proc/match.db"}, 1, "--out /proc/match.db"},
        Mistake{"OutIsAFolder", {"--half", "moving", "--out", "."}, 2, "--out . exists"},
        Mistake{"MissingConfig", {"--half", "moving", "--config", "nope.toml"}, 1, "nope.toml"},
        Mistake{"UnknownKey", {"--half", "moving", "--set", "policy.settle=3"}, 1, "policy.settle: unknown key"},
        Mistake{"ImpossibleValue", {"--half", "moving", "--set", "policy.settle_s=-3"}, 1, "policy.settle_s = -3"},
        Mistake{"DeviceOfRealTime",
                {"--half", "moving", "--set", "hal.kicker=\"rekick\""},
                2,
                "trivela: hal.kicker = \"rekick\" plays with --devices emulated alone\n"},
        Mistake{"MissingRobot", {"--half", "moving", "--set", "run.robot=\"no_one.toml\""}, 1, "no_one.toml"}),
    [](const auto& test) { return test.param.name; });

TEST(Usage, ARecordedMatchIsNeverOverwritten) {
  const tests::Folder folder;
  std::ofstream{folder / "match.db"} << "a match";
  Program match{"trivela", {"match", "--half", "moving", "--out", "match.db"}, folder.path()};
  EXPECT_EQ(match.wait(), 2);
  EXPECT_THAT(match.errors(), HasSubstr("--out match.db exists already"));
  EXPECT_EQ(text_of(folder / "match.db"), "a match");
}

TEST(Usage, ALearnedModelIsFoundFromTheWorkingFolder) {
  const tests::Folder folder;
  std::filesystem::copy_file(std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/learned.toml", folder / "mine.toml");
  Program match{"trivela",
                {"match", "--half", "learned", "--minutes", "0.02", "--set", "kick_decision.learned_model='mine.toml'"},
                folder.path()};
  EXPECT_EQ(match.wait(), 0) << match.errors();
  EXPECT_EQ(match.errors(), "");
}

struct BadNumber {
  std::vector<std::string> arguments;
  std::string says;
};

TEST(Usage, NumbersThatAreNoneAreRefusedWithFlagAndValue) {
  const tests::Folder folder;
  for (const auto& [arguments, says] : std::vector<BadNumber>{
           {{"compare", "--counts", "a=1/2", "b=1/2", "--smallest-effect", "nan"}, "--smallest-effect: nan is not"},
           {{"compare", "--counts", "a=1/2", "b=1/2", "--smallest-effect", "inf"}, "--smallest-effect: inf is not"},
           {{"study", "factorial", "--opponent-median", "1,nan"}, "--opponent-median: nan is not"},
           {{"study", "frontier", "--threshold", "nan"}, "--threshold: nan is not"},
           {{"study", "factorial", "--seed", "-1"}, "--seed: Value -1 not in range"},
           {{"study", "frontier", "--seed", "-1"}, "--seed: Value -1 not in range"},
           {{"study", "sensitivity", "--input", "kicker.delay_s,kicker.delay_s"}, "\"kicker.delay_s\" stands twice"},
           {{"study", "sensitivity", "--seed", "-1"}, "--seed: Value -1 not in range"},
           {{"simulate", "--arms", "moving", "--seed", "-1"}, "--seed: Value -1 not in range"},
           {{"scan", "--synthesize", "x.db", "--seed", "-1"}, "--seed: Value -1 not in range"},
           {{"scan", "--record", "x.db", "--seconds", "-1"}, "--seconds: -1 is not above 0"},
           {{"scan", "--record", "x.db", "--power", "0"}, "--power: 0 is not above 0"},
           {{"solve", "--gravity-mps2", "-9.81"}, "--gravity-mps2: -9.81 is not above 0"},
           {{"calibrate", "deflection", "x.csv", "--v-h-mps", "0"}, "--v-h-mps: 0 is not above 0"},
           {{"calibrate", "rotation", "x.csv", "--distance-m", "-6"}, "--distance-m: -6 is not above 0"}}) {
    Program trivela{"trivela", arguments, folder.path()};
    EXPECT_EQ(trivela.wait(), 2) << says;
    EXPECT_THAT(trivela.errors(), HasSubstr(says));
    EXPECT_LT(trivela.errors().size(), 350u) << "nobody reads more";
    EXPECT_EQ(trivela.output(), "");
  }
}

TEST(Usage, AVerbThatIsNoneIsNamed) {
  const tests::Folder folder;
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"dance"},
                                                    {"dance", "--help"},
                                                    {"calibrate", "dance"},
                                                    {"calibrate", "dance", "--json"}}) {
    Program trivela{"trivela", arguments, folder.path()};
    EXPECT_EQ(trivela.wait(), 2);
    EXPECT_EQ(trivela.errors(), "trivela: there is no verb \"dance\"; trivela --help names them all\n");
  }
  for (const auto& [arguments, says] : std::vector<BadNumber>{
           {{"simulte"}, "there is no verb \"simulte\"; did you mean simulate? trivela --help names them all"},
           {{"macth", "--half", "moving"}, "there is no verb \"macth\"; did you mean match? trivela --help"},
           {{"calibrate", "tabel", "--json"},
            "there is no verb \"tabel\"; did you mean calibrate table? trivela --help"}}) {
    Program trivela{"trivela", arguments, folder.path()};
    EXPECT_EQ(trivela.wait(), 2);
    EXPECT_THAT(trivela.errors(), testing::StartsWith("trivela: " + says));
  }
  Program none{"trivela", {}, folder.path()};
  EXPECT_EQ(none.wait(), 2);
  EXPECT_THAT(none.errors(), HasSubstr("A subcommand is required"));
}

TEST(Usage, AnOptionThatIsNoneNamesTheNearestOfItsVerb) {
  const tests::Folder folder;
  for (const auto& [arguments, meant] : std::vector<BadNumber>{{{"match", "--minuts", "1"}, "--minutes"},
                                                               {{"match", "--minuts=1"}, "--minutes"},
                                                               {{"report", "x.db", "--jsno"}, "--json"},
                                                               {{"report", "x.db", "--json", "--ouut", "y"}, "--out"},
                                                               {{"match", "--zzzzzz"}, ""}}) {
    Program trivela{"trivela", arguments, folder.path()};
    EXPECT_EQ(trivela.wait(), 2);
    EXPECT_THAT(trivela.errors(), HasSubstr("not expected"));
    const std::string question = "trivela: did you mean ";
    if (meant.empty()) {
      EXPECT_EQ(trivela.errors().find(question), std::string::npos) << trivela.errors();
    } else {
      EXPECT_THAT(trivela.errors(), HasSubstr(question + meant + "?"));
    }
  }
}

TEST(Usage, TheHelpGroupsEveryVerbByWhatAPersonWantsWithALineEach) {
  const tests::Folder folder;
  Program help{"trivela", {"--help"}, folder.path()};
  EXPECT_EQ(help.wait(), 0);
  std::istringstream lines{help.output()};
  std::string group;
  std::map<std::string, std::vector<std::string>> verbs;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(':')) group = line;
    if (std::smatch verb; std::regex_match(line, verb, std::regex("  ([a-z][a-z-]*) +[A-Z].*"))) {
      verbs[group].push_back(verb[1]);
      EXPECT_LE(line.size(), 110u) << line;
    }
  }
  using testing::Contains;
  EXPECT_EQ(verbs.size(), 5u);
  EXPECT_THAT(verbs["Play:"], Contains("match"));
  EXPECT_THAT(verbs["Calibrate:"], Contains("calibrate"));
  EXPECT_THAT(verbs["Compare:"], Contains("compare"));
  EXPECT_THAT(verbs["After a match:"], Contains("report"));
  EXPECT_THAT(verbs["On the robot:"], Contains("predict"));
  EXPECT_THAT(verbs["On the robot:"], Contains("hardware"));
  EXPECT_THAT(help.output(), testing::Not(HasSubstr("Subcommands")));
}

TEST(Usage, OneKickIsDrawnAndTwoAreNot) {
  const tests::Folder folder;
  const std::vector<std::string> kick{"solve", "--theta-deg", "36.78", "--d-m", "5.73", "--h-rel-m", "0.59", "--svg"};
  std::vector<std::string> drawn = kick;
  drawn.push_back("kick.svg");
  Program solve{"trivela", drawn, folder.path()};
  EXPECT_EQ(solve.wait(), 0) << solve.errors();
  EXPECT_THAT(text_of(folder / "kick.svg"), HasSubstr("x = 0.00 m, z = 0.70 m"));
  for (const auto& [arguments, says] : std::vector<BadNumber>{
           {{"solve", "--csv", "kicks.csv", "--svg", "k.svg"}, "--svg draws one kick and goes without --csv"},
           {{"predict", "--csv", "-", "--svg", "k.svg"}, "--svg draws one kick and goes without --csv"},
           {{"align", "--svg", "k.svg"}, "--svg"}}) {
    Program trivela{"trivela", arguments, folder.path()};
    EXPECT_EQ(trivela.wait(), 2) << says;
    EXPECT_THAT(trivela.errors(), HasSubstr(says));
  }
  Program steep{
      "trivela", {"solve", "--theta-deg", "5", "--d-m", "1", "--h-rel-m", "3", "--svg", "k.svg"}, folder.path()};
  EXPECT_EQ(steep.wait(), 1);
  EXPECT_THAT(steep.errors(), HasSubstr("no speed solves this kick, there is nothing to draw"));
  EXPECT_FALSE(exists(folder / "k.svg"));
}

TEST(Usage, EveryProgramSaysItsVersionAndItsConfiguration) {
  const tests::Folder folder;
  for (const std::string name : {"trivela", "trivela-recorder", "trivela-kicker_driver", "trivela-simulator"}) {
    Program program{name, {"--version"}, folder.path()};
    EXPECT_EQ(program.wait(), 0) << program.errors();
    EXPECT_THAT(program.output(), testing::MatchesRegex(name + " [0-9]+\\.[0-9]+\\.[0-9]+[^\n]*\n"
                                                               "configuration: " TRIVELA_SOURCE_DIR "/config\n"));
  }
}

TEST(Usage, FilesThatCannotBeWrittenAreSaidBeforeAnythingIsComputed) {
  const tests::Folder folder;
  std::ofstream{folder / "match.db"} << "nothing that anybody could learn from";
  for (const auto& [arguments, says] : std::vector<BadNumber>{
           {{"study", "factorial", "--matches", "1000000", "--csv", "no/f.csv"},
            "cannot write --csv no/f.csv: there is no folder"},
           {{"study", "factorial", "--matches", "1000000", "--svg", "."}, "cannot write --svg .: it is a folder"},
           {{"study", "frontier", "--matches", "1000000", "--svg", "no/f.svg"},
            "cannot write --svg no/f.svg: there is no folder"},
           {{"study", "sensitivity", "--matches", "1000000", "--csv", "no/s.csv"},
            "cannot write --csv no/s.csv: there is no folder"},
           {{"solve", "--theta-deg", "36.78", "--d-m", "5.73", "--h-rel-m", "0.59", "--svg", "no/k.svg"},
            "cannot write --svg no/k.svg: there is no folder"},
           {{"study", "learn", "match.db", "--out", "no/l.toml"}, "cannot write --out no/l.toml: there is no folder"},
           {{"scan", "--synthesize", "s.db", "--truth", "no/t.csv"},
            "cannot write --truth no/t.csv: there is no folder"},
           {{"simulate", "--arms", "moving", "--matches", "1000000", "--out", "no/ab.db"}, "no/ab.db"},
           {{"calibrate", "run", "--in", "simulation", "--out", "no/r.toml"}, "no/r.toml: there is no folder"}}) {
    Program trivela{"trivela", arguments, folder.path()};
    EXPECT_EQ(trivela.wait(), 1) << says;
    EXPECT_THAT(trivela.errors(), HasSubstr(says));
    EXPECT_EQ(trivela.output(), "");
  }
  EXPECT_FALSE(exists(folder / "s.db"));
}

TEST(Usage, EachOutputHasANameAndAFileOfItsOwn) {
  const tests::Folder folder;
  for (const auto& [arguments, says] : std::vector<BadNumber>{
           {{"study", "frontier", "--csv", "f", "--svg", "f"}, "--csv: the same file as --svg: f"},
           {{"study", "frontier", "--results", "./f", "--svg", "f"}, "--results: the same file as --svg: ./f"},
           {{"report", "match.db", "--out", "f", "--html", "./f"}, "the same file as --"},
           {{"compare", "--csv", "f", "--out", "f"}, "--csv: the same file as --out: f"},
           {{"export", "match.db", "--csv", "f", "--mcap", "f"}, "--csv: the same file as --mcap: f"},
           {{"scan", "--synthesize", "f", "--truth", "f"}, "the same file as --synthesize: f"},
           {{"calibrate", "rotation", "in.csv", "--out", "f", "--plot", "f"}, "the same file as --"},
           {{"simulate", "--arms", "moving", "--out", ""}, "--out: needs a name"},
           {{"match", "--half", "moving", "--out", ""}, "--out: needs a name"},
           {{"replay", "match.db", "--out", ""}, "--out: needs a name"},
           {{"compare", "--csv", "f", "--out", ""}, "--out: needs a name"},
           {{"report", "match.db", "--html", ""}, "--html: needs a name"},
           {{"export", "match.db", "--mcap", "", "--csv", "f"}, "--mcap: needs a name"},
           {{"study", "arms", "--json", "--svg", ""}, "--svg: needs a name"},
           {{"merge", "", "match.db"}, "out: needs a name"}}) {
    Program trivela{"trivela", arguments, folder.path()};
    EXPECT_EQ(trivela.wait(), 2) << says;
    EXPECT_THAT(trivela.errors(), HasSubstr(says));
    EXPECT_EQ(trivela.output(), "");
  }
  EXPECT_FALSE(exists(folder / "f"));
}

TEST(Usage, FoldersInPlaceOfFilesAreSaidSo) {
  const tests::Folder folder;
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"simulate", "--arms", "moving", "--config", "."},
                                             {"simulate", "--arms", "moving", "--scenario", "."},
                                             {"simulate", "--arms", "moving", "--robot", "."},
                                             {"solve", "--csv", "."},
                                             {"compare", "--csv", "."},
                                             {"lob", "--points", ".", "--laser-x-m", "4", "--laser-z-m", "0"},
                                             {"calibrate", "table", ".", "--robot", "seven"},
                                             {"calibrate", "deflection", "."},
                                             {"report", "."},
                                             {"compare", "."},
                                             {"replay", "."},
                                             {"scan", "--info", "."},
                                             {"scan", "--emulate", "."},
                                             {"lob", "--replay", "."}}) {
    Program trivela{"trivela", arguments, folder.path()};
    EXPECT_GE(trivela.wait(), 1) << arguments.front();
    EXPECT_THAT(trivela.errors(), testing::Not(HasSubstr("basic_")));
    EXPECT_THAT(trivela.errors(), testing::Not(HasSubstr("Success")));
    EXPECT_THAT(trivela.errors(), HasSubstr("."));
    EXPECT_LT(trivela.errors().size(), 350u);
  }
}

/// What a program writes to a terminal of so many columns.
std::string on_terminal(const tests::Folder& folder, const std::string& term, int columns, const std::string& command) {
  const auto tests = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::string all = fmt::format("cd {} && TERM={} script -qec 'stty cols {}; {}/{}' typescript > /dev/null 2>&1",
                                      folder.path().string(), term, columns, tests.parent_path().string(), command);
  EXPECT_EQ(WEXITSTATUS(std::system(all.c_str())), 0) << command;
  std::string text = text_of(folder / "typescript");
  return text.substr(text.find('\n') + 1);
}

TEST(Usage, AFileThatCannotBeReadIsNoBadUsageWhateverTheFlag) {
  const tests::Folder folder;
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"simulate", "--arms", "moving", "--scenario", "no.toml"},
                                             {"simulate", "--arms", "moving", "--robot", "no.toml"},
                                             {"match", "--half", "moving", "--config", "no.toml"},
                                             {"compare", "--csv", "no.toml"}}) {
    Program trivela{"trivela", arguments, folder.path()};
    EXPECT_EQ(trivela.wait(), 1) << arguments.front();
    EXPECT_THAT(trivela.errors(), HasSubstr("no.toml"));
  }
}

TEST(Usage, ATeamThatPlaysWithoutKeysIsToldWhatThatMeans) {
  const tests::Folder folder;
  const std::string team = TRIVELA_SOURCE_DIR "/config/teams/example.toml";
  Program check{"trivela", {"team", "check", team}, folder.path()};
  EXPECT_EQ(check.wait(), 0) << check.errors();
  EXPECT_THAT(check.output(), HasSubstr("without keys: any program on these networks can stop the robots"));
}

TEST(Usage, ADumbTerminalGetsNoEscapesAndNoLineThatIsDrawnOver) {
  const tests::Folder folder;
  const std::string simulate = "trivela simulate --arms moving --matches 2 --possessions 2 --out log.db";
  const std::string said = on_terminal(folder, "dumb", 40, simulate);
  EXPECT_THAT(said, testing::Not(HasSubstr("\x1b")));
  EXPECT_THAT(said, testing::Not(testing::ContainsRegex("\r[^\r\n]")));
  EXPECT_THAT(said, HasSubstr("on target"));
  const std::string top = on_terminal(folder, "dumb", 40, "trivela top --domain 97 --interval 0.2 --once");
  EXPECT_THAT(top, testing::Not(HasSubstr("\x1b")));
  std::istringstream lines{top};
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(line.starts_with("Script") || line.size() <= 41) << line;
  std::filesystem::remove(folder / "log.db");
  EXPECT_THAT(on_terminal(folder, "xterm", 40, simulate), HasSubstr("\x1b[K")) << "another one shows progress";
}

TEST(Usage, AFullDiskIsSaid) {
  const tests::Folder folder;
  std::ofstream{folder / "kicks.csv"} << "policy,on_target\na,1\nb,0\n";
  const auto tests = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::string program = (tests.parent_path() / "trivela").string();
  for (const std::string verb : {"compare --csv kicks.csv", "compare --csv kicks.csv --json", "--help",
                                 "study frontier --matches 2 --possessions 1 --threshold 0.5", "solve --help"}) {
    const std::string command = "cd " + folder.path().string() + " && " + program + " " + verb;
    const int status = std::system((command + " > /dev/full 2> said").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << verb;
    EXPECT_EQ(text_of(folder / "said"), "trivela: cannot write the output: No space left on device\n") << verb;
  }
}

}  // namespace
}  // namespace trivela::e2e
