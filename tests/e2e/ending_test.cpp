// Matches that end before they are over.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <random>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/running_match.hpp"

namespace trivela::e2e {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr std::chrono::milliseconds kAtOnce{0};
constexpr std::chrono::seconds kSoon{20};

// The log is closed, whole and worth reading.
void expect_finalised(const std::filesystem::path& path) {
  EXPECT_THAT(loose_ends_of(path), IsEmpty());
  const Reader log{path};
  EXPECT_THAT(log.warnings(), IsEmpty());
  EXPECT_THAT(gaps_of(log), IsEmpty());
  EXPECT_THAT(losses_of(log), IsEmpty());
  EXPECT_GT(number_of(log, "SELECT count(*) FROM world_states"), 100);
}

TEST(Ending, AMatchStartsOneProcessPerNode) {
  RunningMatch match;
  std::vector<std::string> programs;
  for (const auto& [program, watch] : match.nodes()) programs.push_back(program);
  EXPECT_THAT(programs, testing::ElementsAre("trivela-kick_decision", "trivela-kicker_driver", "trivela-odometry",
                                             "trivela-recorder", "trivela-shot_observer", "trivela-simulator",
                                             "trivela-world_state"));
}

TEST(Ending, CtrlCLeavesAValidLogAndNoProcess) {
  RunningMatch match;
  match.program().signal(SIGINT);
  EXPECT_EQ(match.program().wait(), 1);
  EXPECT_THAT(match.nodes_left(kAtOnce), IsEmpty());
  EXPECT_THAT(match.program().errors(), AllOf(HasSubstr("interrupted"), HasSubstr("match.db")));
  EXPECT_THAT(match.folder().files(".toml"), IsEmpty());
  expect_finalised(match.log());
}

TEST(Ending, SigtermIsAsGood) {
  RunningMatch match;
  match.program().signal(SIGTERM);
  EXPECT_EQ(match.program().wait(), 1);
  EXPECT_THAT(match.nodes_left(kAtOnce), IsEmpty());
  expect_finalised(match.log());
}

TEST(Ending, ASimulatorThatIsAskedToStopDoesNotMakeTheMatchWhole) {
  RunningMatch match;
  kill(match.node("trivela-simulator").id(), SIGTERM);
  EXPECT_EQ(match.program().wait(), 1);
  EXPECT_THAT(match.program().errors(),
              AllOf(HasSubstr("simulator was stopped before the end"), HasSubstr("match.db")));
  expect_finalised(match.log());
  Program report{"trivela", {"report", "match.db"}, match.folder().path()};
  EXPECT_EQ(report.wait(), 3);
  EXPECT_THAT(report.output(), HasSubstr("CUT SHORT"));
}

TEST(Ending, CtrlCBeforeTheFirstCycleLeavesNoProcess) {
  const tests::Folder folder;
  Program match{"trivela", {"match", "--half", "moving", "--out", "match.db"}, folder.path()};
  // The recorder, which is the first node, makes the log.
  ASSERT_TRUE(wait_for_change(folder.path(), match.watch(), [&] { return children_of(match.id()).size() >= 1; }));
  std::vector<ProcessWatch> nodes;
  for (const pid_t child : children_of(match.id())) nodes.emplace_back(child);
  match.signal(SIGINT);
  EXPECT_EQ(match.wait(), 1);
  for (const ProcessWatch& node : nodes) EXPECT_TRUE(node.ended(kAtOnce)) << node.id();
  EXPECT_THAT(match.errors(), HasSubstr("interrupted after"));
  EXPECT_THAT(match.errors(), Not(HasSubstr("stopping"))) << "the match itself ended nodes that did not listen yet";
  EXPECT_THAT(folder.files(".toml"), IsEmpty());
}

// Whether the process ends soon.
bool ended(pid_t id) try { return ProcessWatch{id}.ended(kSoon); } catch (const std::runtime_error&) {
  return true;  // it has
}

class KilledNode : public testing::TestWithParam<const char*> {};

TEST_P(KilledNode, EndsTheMatchWhichNamesItAndKeepsTheLog) {
  const std::string node = GetParam();
  RunningMatch match;
  kill(match.node("trivela-" + node).id(), SIGKILL);
  EXPECT_EQ(match.program().wait(), 1);
  EXPECT_THAT(match.program().errors(), AllOf(HasSubstr(node + " died"), HasSubstr("Killed"), HasSubstr("match.db")));
  EXPECT_THAT(match.program().errors(), Not(HasSubstr("did not stop")));
  EXPECT_THAT(match.nodes_left(kAtOnce), IsEmpty());
  EXPECT_THAT(match.folder().files(".toml"), IsEmpty());
  expect_finalised(match.log());
}

INSTANTIATE_TEST_SUITE_P(Ending, KilledNode,
                         testing::Values("odometry", "world_state", "kick_decision", "kicker_driver", "shot_observer",
                                         "simulator"),
                         [](const auto& test) { return std::string{test.param}; });

TEST(Ending, ANodeThatDiesAtTheStartDoesNotKeepTheOthers) {
  const tests::Folder folder;
  Program match{"trivela", {"match", "--half", "moving", "--out", "match.db"}, folder.path()};
  // The recorder is the first child; the simulator waits for every other one.
  ASSERT_TRUE(wait_for_change(folder.path(), match.watch(), [&] { return !children_of(match.id()).empty(); }));
  kill(children_of(match.id()).front(), SIGKILL);
  EXPECT_EQ(match.wait(), 1);
  EXPECT_THAT(match.errors(), AllOf(HasSubstr("recorder died"), Not(HasSubstr("did not stop"))));
  EXPECT_THAT(folder.files(".toml"), IsEmpty());
}

TEST(Ending, AKilledMatchLeavesNoNodeBehind) {
  RunningMatch match;
  match.program().signal(SIGKILL);
  EXPECT_EQ(match.program().wait(), 128 + SIGKILL);
  EXPECT_THAT(match.nodes_left(kSoon), IsEmpty());
  expect_finalised(match.log());
}

TEST(Ending, AKilledMatchLeavesNoFileAndNoProcessWheneverThatHappens) {
  std::mt19937 random{20261122};
  for (int kill = 0; kill < 24; ++kill) {
    const tests::Folder folder;
    Program match{"trivela", {"match", "--half", "moving", "--out", "match.db"}, folder.path()};
    // Most of what may be left behind is made in the first tenth of a second.
    const std::chrono::milliseconds moment{random() % (kill % 2 == 0 ? 100 : 1000)};
    SCOPED_TRACE(fmt::format("killed after {} ms", moment.count()));
    ASSERT_FALSE(match.watch().ended(moment)) << match.errors();
    match.signal(SIGKILL);
    EXPECT_EQ(match.wait(), 128 + SIGKILL);
    for (auto left = processes_in(folder.path()); !left.empty(); left = processes_in(folder.path())) {
      for (const pid_t id : left) ASSERT_TRUE(ended(id)) << program_of(id);
    }
    std::vector<std::string> files = folder.files("");
    std::erase_if(files, [](const std::string& file) { return file == "trivela.0.out" || file == "trivela.0.err"; });
    if (files.empty()) continue;
    // A recorder that had begun closes its log.
    EXPECT_THAT(files, testing::ElementsAre("match.db"));
    const Reader log{folder / "match.db"};
    ASSERT_EQ(log.sessions().size(), 1u);
    EXPECT_TRUE(log.sessions()[0].closed_t_ns);
  }
}

}  // namespace
}  // namespace trivela::e2e
