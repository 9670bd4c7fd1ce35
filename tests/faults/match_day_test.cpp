// The day of a match, as docs/team.md has it: each machine is configured and its launcher started, the team plays
// through an outage, and its logs become one. By hand: TRIVELA_TEAM_ROBOTS=5 TRIVELA_TEAM_OUTAGE_S=20.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>
#include <sstream>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/faults/launched_team.hpp"
#include "tests/faults/team_on_air.hpp"
#include "tests/support/folder.hpp"

namespace trivela::faults {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

constexpr seconds kTimeout{120};
constexpr int kWithLoss = 3;

double by_hand(const char* variable, double otherwise) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atof(text);
}

class MatchDay : public testing::Test {
 protected:
  void SetUp() override {
    const std::string network = NetworkHost::obstacle();
    if (!network.empty()) GTEST_SKIP() << "no network namespaces here: " << network;
    e2e::Program rsync{"/bin/sh", {"-c", "command -v rsync"}, folder.path()};
    if (rsync.wait() != 0) GTEST_SKIP() << "no rsync here";
  }

  /// `trivela` with these arguments; what it said goes to `said`.
  int trivela(std::vector<std::string> arguments) {
    e2e::Program program{"trivela", std::move(arguments), folder.path()};
    const int code = program.wait();
    said = program.output() + program.errors();
    return code;
  }

  /// Each robot has played so many cycles from its newest instant on, or has stood for so many.
  bool all(const LaunchedTeam& team, bool playing, std::int64_t cycles) const {
    std::vector<std::int64_t> from;
    for (std::size_t robot = 1; robot <= robots; ++robot)
      from.push_back(number_in(team.logs(robot), "SELECT max(t_ns) FROM world_states"));
    return team.wait_for(kTimeout, [&] {
      for (std::size_t robot = 1; robot <= robots; ++robot)
        if (number_in(team.logs(robot),
                      fmt::format("SELECT count(*) FROM world_states WHERE playing = {} AND t_ns > {}", playing ? 1 : 0,
                                  from[robot - 1])) < cycles)
          return false;
      return true;
    });
  }

  std::string said_by_all(const LaunchedTeam& team) const {
    std::string text;
    for (std::size_t machine = 0; machine <= robots; ++machine) text += team.said(machine);
    return text;
  }

  /// Fetches every machine's logs and merges them into merged.db, whose report is `said`; the exit code of merge.
  int collect_and_merge(const LaunchedTeam& team, std::int64_t& kicks) {
    EXPECT_EQ(trivela({"collect", team.team_file(), team.host_of_logs(0), "--to", "here", "--ssh", team.ssh()}), 0);
    EXPECT_THAT(said, HasSubstr("missing: nothing"));
    std::vector<std::string> arguments{"merge", "merged.db"};
    for (const auto& entry : fs::recursive_directory_iterator{folder / "here"}) {
      if (entry.path().extension() != ".db") continue;
      arguments.push_back(entry.path().string());
      kicks += number_in({entry.path()}, "SELECT count(*) FROM kick_truths");
    }
    EXPECT_EQ(arguments.size(), 2 + robots + 1) << "a log of each machine";
    return trivela(arguments);
  }

  tests::Folder folder;
  std::string said;
  std::size_t robots = static_cast<std::size_t>(by_hand("TRIVELA_TEAM_ROBOTS", 2));
};

/// What follows the last "missing:" that a verb said, a line each; none where nothing is missing.
std::vector<std::string> missing_in(const std::string& said) {
  std::vector<std::string> lines;
  const std::size_t at = said.rfind("missing:");
  if (at == std::string::npos) return {"it says nothing of what is missing"};
  std::istringstream text{said.substr(said.find('\n', at) + 1)};
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Losses and silences that the recorders of these streams counted: not of the team, whose robots hear their own nodes
/// by the loopback, but of a machine that has too much to do.
std::int64_t lost_by_the_machine(const e2e::Reader& merged, const std::string& streams) {
  return e2e::number_of(
      merged,
      fmt::format("SELECT count(*) FROM losses WHERE {} AND (CASE robot_id WHEN 0 THEN max(lost, gaps) + overflow + "
                  "nan_refused + rejected > 0 ELSE to_t_ns IS NOT NULL END)",
                  streams));
}

/// Whether a line is of what crosses the air alone, or counts more of them.
bool is_of_the_air(const std::string& line) {
  static const std::regex pattern{R"((referee|team_state) of .* silent from .*\([0-9.]+ s\)|more silences)"};
  return std::regex_search(line, pattern);
}

TEST_F(MatchDay, ATeamThatIsConfiguredAndLaunchedPlaysAndOneLogMissesNothing) {
  LaunchedTeam team{folder.path(), robots, "0.1 FIRST_HALF\n0.3 START\n100000 STOP\n"};
  team.configure();
  team.start();
  ASSERT_TRUE(all(team, true, 250)) << said_by_all(team);
  EXPECT_THAT(team.stop(), Each(0)) << said_by_all(team);
  std::int64_t kicks = 0;
  const int code = collect_and_merge(team, kicks);
  const e2e::Reader merged{folder / "merged.db"};
  EXPECT_EQ(e2e::number_of(merged, "SELECT count(*) FROM kick_truths"), kicks);
  if (lost_by_the_machine(merged, "1") > 0) GTEST_SKIP() << "this machine could not keep up:\n" << said;
  EXPECT_EQ(code, 0);
  EXPECT_THAT(said, testing::EndsWith("missing: nothing\n"));
  trivela({"report", "merged.db"});
  EXPECT_THAT(said, AllOf(HasSubstr("lost: nothing"), Not(testing::ContainsRegex("silent from [0-9.]+ s to [0-9]"))));
}

TEST_F(MatchDay, AnOutageOfTheBaseIsAllThatTheOneLogMisses) {
  const double outage_s = by_hand("TRIVELA_TEAM_OUTAGE_S", 3.0);
  LaunchedTeam team{folder.path(), robots, "0.1 FIRST_HALF\n0.3 START\n100000 STOP\n"};
  team.configure();
  team.start();
  ASSERT_TRUE(all(team, true, 100)) << said_by_all(team);
  team.cut(0);
  team.wait_for(seconds{static_cast<std::int64_t>(outage_s)}, [] { return false; });
  ASSERT_TRUE(all(team, false, 20)) << "a robot went on without its referee";
  team.air({.delay = milliseconds{1}});
  ASSERT_TRUE(all(team, true, 150)) << "a robot never played on" << said_by_all(team);
  EXPECT_THAT(team.stop(), Each(0)) << said_by_all(team);

  std::int64_t kicks = 0;
  EXPECT_EQ(collect_and_merge(team, kicks), kWithLoss);
  fmt::print("{}", said);
  const e2e::Reader merged{folder / "merged.db"};
  const bool kept_up = lost_by_the_machine(merged, "stream <> 'referee' AND stream NOT LIKE 'team_state%'") == 0;
  for (const std::string& line : missing_in(said)) EXPECT_TRUE(!kept_up || is_of_the_air(line)) << line;
  EXPECT_EQ(
      e2e::number_of(merged, fmt::format("SELECT count(DISTINCT robot_id) FROM losses WHERE stream = 'referee' AND "
                                         "robot_id > 0 AND to_t_ns - from_t_ns > {}",
                                         0.9e9 * outage_s)),
      static_cast<std::int64_t>(robots))
      << "each robot missed him, and says how long";
  EXPECT_EQ(e2e::number_of(merged, "SELECT count(*) FROM kick_truths"), kicks);
  EXPECT_EQ(trivela({"report", "merged.db"}), kWithLoss);
  EXPECT_THAT(said, HasSubstr(" silent from "));
}

}  // namespace
}  // namespace trivela::faults
