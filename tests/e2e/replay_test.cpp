// A recorded match is decided again, and a disk that does not keep up costs no row.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::string> kMatch{"match",     "--half", "stopped", "--half", "moving",
                                      "--minutes", "0.4",    "--seed",  "7",      "--out"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// What is not alike of the rows that both a match and its replay have.
std::vector<std::string> decided_otherwise(const tests::Folder& folder, const char* one, const char* other) {
  std::vector<std::string> tables;
  for (const std::string& difference : differences_of(Reader{folder / one}, Reader{folder / other})) {
    const std::string table = difference.substr(0, difference.find(','));
    for (const char* const decided : {"world_states", "kick_decisions", "shadow_decisions", "kick_orders",
                                      "drive_commands", "assignments", "referee"})
      if (table == decided) tables.push_back(difference);
  }
  return tables;
}

std::string replay(const tests::Folder& folder, const std::vector<std::string>& more, int code = 0) {
  Program program{"trivela", with({"replay"}, more), folder.path()};
  EXPECT_EQ(program.wait(), code) << program.errors();
  return program.output() + program.errors();
}

TEST(Replay, GivesTheRowsOfALockstepMatchAgainAndOtherOrdersWithAnotherPolicy) {
  const tests::Folder folder;
  Program match{"trivela", with(kMatch, {"match.db"}), folder.path()};
  ASSERT_EQ(match.wait(), 0) << match.errors();
  EXPECT_THAT(replay(folder, {"match.db", "--out", "same.db"}), HasSubstr("the same decisions: "));
  EXPECT_GT(number_of(Reader{folder / "match.db"}, "SELECT count(*) FROM kick_orders"), 0);
  EXPECT_THAT(decided_otherwise(folder, "match.db", "same.db"), IsEmpty());

  const std::string said =
      replay(folder, {"match.db", "--out", "moving.db", "--set", "kick_decision.policy_by_half=[\"moving\"]"});
  EXPECT_THAT(said, HasSubstr("Open loop: "));
  EXPECT_THAT(said, testing::ContainsRegex("[1-9][0-9]* earlier in the replay"));
  EXPECT_EQ(number_of(Reader{folder / "moving.db"}, "SELECT count(*) FROM kick_decisions WHERE policy = 'stopped'"), 0);

  EXPECT_EQ(Reader{folder / "same.db"}.sessions()[0].replays_uuid, Reader{folder / "match.db"}.sessions()[0].uuid);
  Program both{"trivela", {"compare", "match.db", "same.db", "--json"}, folder.path()};
  EXPECT_EQ(both.wait(), 0) << both.errors();
  Program alone{"trivela", {"compare", "match.db", "--json"}, folder.path()};
  EXPECT_EQ(alone.wait(), 0) << alone.errors();
  EXPECT_THAT(both.output(), HasSubstr("same.db: 1 of its sessions replays another one and is left out"));
  EXPECT_EQ(nlohmann::json::parse(both.output()).at("groups"), nlohmann::json::parse(alone.output()).at("groups"));

  Program report{"trivela", {"report", "same.db"}, folder.path()};
  EXPECT_EQ(report.wait(), 0) << report.errors();
  EXPECT_THAT(report.output(), HasSubstr("replay of match.db"));
  Program page{"trivela", {"report", "match.db", "moving.db", "--html", "page.html"}, folder.path()};
  EXPECT_EQ(page.wait(), 0) << page.errors();
  EXPECT_THAT(text_of(folder / "page.html"), HasSubstr("match.db, decided again in moving.db"));
}

TEST(Replay, GoesByWhatWasLearnedOfTheKickerInTheSameCycles) {
  const tests::Folder folder;
  Program match{"trivela",
                {"match", "--half", "predictive", "--minutes", "0.5", "--seed", "7", "--set",
                 "self_calibration.mode='on'", "--out", "match.db"},
                folder.path()};
  ASSERT_EQ(match.wait(), 0) << match.errors();
  EXPECT_GT(number_of(Reader{folder / "match.db"}, "SELECT count(DISTINCT estimate) FROM kick_decisions"), 3);
  replay(folder, {"match.db", "--out", "same.db"});
  EXPECT_THAT(decided_otherwise(folder, "match.db", "same.db"), IsEmpty());
  replay(folder, {"match.db", "--out", "file.db", "--set", "self_calibration.mode='off'"});
  EXPECT_EQ(number_of(Reader{folder / "file.db"}, "SELECT count(*) FROM kick_decisions WHERE estimate <> 0"), 0);
}

TEST(Replay, GivesTheDecisionsOfAMatchInRealTimeAgain) {
  const tests::Folder folder;
  Program match{"trivela",
                {"match", "--devices", "emulated", "--half", "moving", "--half", "predictive", "--minutes", "0.15",
                 "--out", "match.db"},
                folder.path()};
  ASSERT_EQ(match.wait(), 0) << match.errors();
  const std::string said = replay(folder, {"match.db", "--out", "same.db"});
  EXPECT_THAT(said, HasSubstr("inputs crossed"));
  const std::int64_t decisions = number_of(Reader{folder / "match.db"}, "SELECT count(*) FROM kick_decisions");
  EXPECT_GT(decisions, 0);
  EXPECT_THAT(said, HasSubstr(fmt::format("the same decisions: {0} of {0} (100.00 %)", decisions)));
  const auto orders = [&](const char* log) {
    return rows_of(Reader{folder / log}, "SELECT t_ns, power, fire_t_ns FROM kick_orders ORDER BY t_ns");
  };
  EXPECT_EQ(orders("match.db"), orders("same.db"));
  EXPECT_THAT(replay(folder, {"match.db", "--out", "other.db", "--robot",
                              TRIVELA_SOURCE_DIR "/config/robots/uncalibrated.toml"}),
              HasSubstr("the same decisions: "));
}

TEST(Replay, DecidesTheSessionThatIsNamed) {
  const tests::Folder folder;
  for (const char* const seed : {"7", "8"}) {
    const std::string log = fmt::format("match_{}.db", seed);
    Program match{
        "trivela", {"match", "--half", "moving", "--minutes", "0.2", "--seed", seed, "--out", log}, folder.path()};
    ASSERT_EQ(match.wait(), 0) << match.errors();
  }
  Program merge{"trivela", {"merge", "both.db", "match_7.db", "match_8.db"}, folder.path()};
  ASSERT_EQ(merge.wait(), 0) << merge.errors();
  for (const char* const log : {"match_7.db", "match_8.db"}) {
    const std::string uuid = Reader{folder / log}.sessions()[0].uuid;
    EXPECT_THAT(replay(folder, {"both.db", "--out", "out.db"}, 2), HasSubstr(uuid));
    const std::string out = fmt::format("again_{}", log);
    replay(folder, {"both.db", "--session", uuid.substr(0, 30), "--out", out});
    EXPECT_EQ(Reader{folder / out}.sessions()[0].replays_uuid, uuid);
    EXPECT_THAT(decided_otherwise(folder, log, out.c_str()), IsEmpty());
  }
  EXPECT_FALSE(exists(folder / "out.db"));
}

/// The log with the robot's rows once more, as those of a robot 2 that was recorded in the same session.
void add_a_second_robot(const std::filesystem::path& log) {
  SQLite::Database database{log.string(), SQLite::OPEN_READWRITE};
  const auto names_of = [&](const std::string& sql) {
    std::vector<std::string> names;
    for (SQLite::Statement query{database, sql}; query.executeStep();) names.push_back(query.getColumn(0).getString());
    return names;
  };
  constexpr std::int64_t kOneRobotOn = std::int64_t{1} << 40;  // in a kick_id
  database.exec("DELETE FROM digests; DELETE FROM tallied_sessions; UPDATE sessions SET closed_t_ns = NULL");
  for (const std::string& table : names_of(
           "SELECT name FROM sqlite_schema AS t WHERE type = 'table' AND name NOT LIKE '%tallies' AND name NOT IN "
           "('sessions', 'losses') AND EXISTS (SELECT 1 FROM pragma_table_info(t.name) WHERE name = 'robot_id')")) {
    const auto columns = names_of("SELECT name FROM pragma_table_info('" + table + "')");
    std::vector<std::string> values = columns;
    for (std::string& value : values) {
      if (value == "robot_id") value = "2";
      if (value == "kick_id" || value == "last_kick_id")
        value = fmt::format("CASE WHEN {0} > 0 THEN {0} + {1} ELSE {0} END", value, kOneRobotOn);
    }
    database.exec(fmt::format("INSERT INTO {0} ({1}) SELECT {2} FROM {0} WHERE robot_id = 1", table,
                              fmt::join(columns, ", "), fmt::join(values, ", ")));
  }
}

TEST(Replay, DecidesEachRobotOfASessionByItsOwnRows) {
  const tests::Folder folder;
  Program match{"trivela", with(kMatch, {"match.db"}), folder.path()};
  ASSERT_EQ(match.wait(), 0) << match.errors();
  add_a_second_robot(folder / "match.db");
  const std::string said = replay(folder, {"match.db", "--out", "same.db"});
  EXPECT_THAT(said, testing::AllOf(HasSubstr("robot 1: "), HasSubstr("robot 2: ")));
  EXPECT_GT(number_of(Reader{folder / "same.db"}, "SELECT count(*) FROM kick_orders WHERE robot_id = 2"), 0);
  EXPECT_THAT(decided_otherwise(folder, "match.db", "same.db"), IsEmpty());

  // One of the two loses the ball for the first ten seconds: the other one's decisions stay.
  SQLite::Database{(folder / "match.db").string(), SQLite::OPEN_READWRITE}.exec(
      "UPDATE vision_frames SET ball_seen = 0 WHERE robot_id = 2 AND t_exposure_ns < 10000000000");
  replay(folder, {"match.db", "--out", "other.db"});
  const auto decisions = [&](const char* log, int robot_id) {
    return rows_of(
        Reader{folder / log},
        fmt::format("SELECT t_ns, fire, reason FROM kick_decisions WHERE robot_id = {} ORDER BY seq", robot_id));
  };
  EXPECT_EQ(decisions("other.db", 1), decisions("same.db", 1));
  EXPECT_NE(decisions("other.db", 2), decisions("same.db", 2));
}

TEST(Replay, KeepsAndSaysWhatItDecidedWhereItIsStopped) {
  const tests::Folder folder;
  Program match{"trivela", with(kMatch, {"match.db"}), folder.path()};
  ASSERT_EQ(match.wait(), 0) << match.errors();
  Program stopped{"trivela", {"replay", "match.db", "--out", "part.db"}, folder.path(), [] {
                    sigset_t interrupt;  // it waits until the program looks for it, which is in the middle
                    sigemptyset(&interrupt);
                    sigaddset(&interrupt, SIGINT);
                    sigprocmask(SIG_BLOCK, &interrupt, nullptr);
                    raise(SIGINT);
                  }};
  EXPECT_EQ(stopped.wait(), 3) << stopped.errors();
  EXPECT_THAT(stopped.errors(), HasSubstr("stopped: part.db holds what was decided so far"));
  const auto decisions = [&](const char* log) {
    return number_of(Reader{folder / log}, "SELECT count(*) FROM kick_decisions");
  };
  EXPECT_LT(decisions("part.db"), decisions("match.db"));
  Program report{"trivela", {"report", "part.db"}, folder.path()};
  EXPECT_EQ(report.wait(), 0) << report.errors();
}

TEST(Replay, RefusesWhatItCannotDecideAgain) {
  const tests::Folder folder;
  Program simulate{"trivela", {"simulate", "--arms", "moving", "--matches", "1", "--out", "sim.db"}, folder.path()};
  ASSERT_EQ(simulate.wait(), 0) << simulate.errors();
  EXPECT_THAT(replay(folder, {"sim.db", "--out", "out.db"}, 1),
              HasSubstr("sim.db: no session of it has wheel samples"));
  Program match{"trivela", with(kMatch, {"match.db"}), folder.path()};
  ASSERT_EQ(match.wait(), 0) << match.errors();
  EXPECT_THAT(replay(folder, {"match.db", "--out", "out.db", "--set", "hal.wheels=\"cia402\""}, 2),
              HasSubstr("plays no part in a replay"));
  EXPECT_THAT(replay(folder, {"match.db", "--out", "match.db"}, 2), HasSubstr("never overwritten"));
  EXPECT_THAT(replay(folder, {"match.db", "--session", "none", "--out", "out.db"}, 2), HasSubstr(": robot 1"));
  EXPECT_FALSE(exists(folder / "out.db"));
}

TEST(Match, WaitsForADiskThatDoesNotKeepUp) {
  const tests::Folder folder;
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
