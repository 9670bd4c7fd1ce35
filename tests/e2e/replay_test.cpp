// A recorded match goes through the nodes again, and a disk that does not keep up costs no row.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/folder.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"

namespace trivela::e2e {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const std::vector<std::string> kMatch{"match",     "--half", "stopped", "--half", "moving",
                                      "--minutes", "0.4",    "--seed",  "7",      "--out"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Replay, GivesTheDecisionsOfTheMatchAgainAndOtherOnesWithAnotherPolicy) {
  const Folder folder;
  Program match{"trivela", with(kMatch, {"match.db"}), folder.path()};
  ASSERT_EQ(match.wait(), 0) << match.errors();
  Program same{"trivela", {"replay", "match.db", "--out", "same.db"}, folder.path()};
  ASSERT_EQ(same.wait(), 0) << same.errors();
  Program moving{"trivela",
                 {"replay", "match.db", "--out", "moving.db", "--set", "kick_decision.policy_by_half=[\"moving\"]"},
                 folder.path()};
  ASSERT_EQ(moving.wait(), 0) << moving.errors();

  const Reader original{folder / "match.db"};
  const Reader replayed{folder / "same.db"};
  EXPECT_GT(number_of(original, "SELECT count(*) FROM kick_orders"), 0);
  // Only the simulator knows the truth, so that a replay has none; nor is it the same session.
  std::vector<std::string> tables;
  for (const std::string& difference : differences_of(original, replayed)) {
    tables.push_back(difference.substr(0, difference.find(',')));
  }
  std::erase(tables, "sqlite_stat1");  // SQLite's own counts of rows, where it makes some
  EXPECT_THAT(tables, UnorderedElementsAre("kick_truths", "possession_truths", "possession_tallies", "losses",
                                           "sessions", "digests"));
  EXPECT_EQ(number_of(Reader{folder / "moving.db"}, "SELECT count(*) FROM kick_decisions WHERE policy = 'stopped'"), 0);

  EXPECT_EQ(replayed.sessions()[0].replays_uuid, original.sessions()[0].uuid);
  Program both{"trivela", {"compare", "match.db", "same.db", "--json"}, folder.path()};
  EXPECT_EQ(both.wait(), 0) << both.errors();
  Program alone{"trivela", {"compare", "match.db", "--json"}, folder.path()};
  EXPECT_EQ(alone.wait(), 0) << alone.errors();
  EXPECT_THAT(both.output(), HasSubstr("same.db: 1 of its sessions replays another one and is left out"));
  EXPECT_EQ(nlohmann::json::parse(both.output()).at("groups"), nlohmann::json::parse(alone.output()).at("groups"));

  Program report{"trivela", {"report", "same.db"}, folder.path()};
  EXPECT_EQ(report.wait(), 0) << report.errors();
  EXPECT_THAT(report.output(), HasSubstr("replay of match.db"));
}

TEST(Match, WaitsForADiskThatDoesNotKeepUp) {
  const Folder folder;
  Program match{
      "trivela",
      with(kMatch, {"match.db", "--set", "recorder.queue_capacity=300", "--set", "recorder.group_commit_s=1"}),
      folder.path()};
  EXPECT_EQ(match.wait(), 0) << match.errors();
  const Reader log{folder / "match.db"};
  EXPECT_THAT(gaps_of(log), IsEmpty());
  EXPECT_THAT(losses_of(log), IsEmpty());
}

}  // namespace
}  // namespace trivela::e2e
