// Logs of several robots as one.
#include "log/merge/merge.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <map>

#include "evaluator/sessions/merge_report.hpp"
#include "evaluator/table2/table2.hpp"
#include "log/file/new_file.hpp"
#include "log/schema/row_digest.hpp"
#include "log/write/additions.hpp"
#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/report_of_log.hpp"

namespace trivela::evaluator {
namespace {

using log::Check;
using log::Reader;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Path = std::filesystem::path;

constexpr std::int64_t kMs = 1'000'000;

class Merge : public LogTest {
 protected:
  static log::Session of_robot(int robot_id) {
    log::Session session = LogTest::session();
    session.robot_id = robot_id;
    session.simulated_clock = session.simulated = false;
    session.seed.reset();
    return session;
  }

  /// A robot's log with `on_target` and `over` kicks in the two halves.
  Path robot_log(const std::string& name, int robot_id, int on_target, int over, const std::string& uuid = "") {
    log::Session session = of_robot(robot_id);
    session.uuid = uuid;
    MatchLog match(path(name), session, options());
    match.robot_id = robot_id;
    match.kicks(1, "on_target", on_target);
    match.kicks(2, "over", over);
    match.close();
    return path(name);
  }

  log::Merged merged(const std::vector<Path>& from, const std::string& to = "merged.db",
                     std::optional<int> reference = {}) const {
    return log::merge(from, path(to), {reference, {}});
  }

  MergeReport said(const log::Merged& merged, const std::string& name = "merged.db") const {
    return report_merge(merged, Reader(path(name)));
  }

  /// Kicks of Table 2 by policy and outcome.
  static std::map<std::string, std::int64_t> table2_of(const Path& log) {
    std::map<std::string, std::int64_t> counts;
    for (const PolicyRow& row : make_report(Reader(log)).policies) {
      for (const char* const outcome : {"on_target", "over"}) counts[row.policy + " " + outcome] += row.of(outcome);
    }
    return counts;
  }

  static std::map<std::string, std::vector<std::string>> rows_of_all(const Path& log) {
    SQLite::Database database(log.string());
    std::map<std::string, std::vector<std::string>> rows;
    for (const std::string& table : log::tables_of(database)) {
      if (table.starts_with("sqlite_")) continue;  // what the library knows of its tables
      SQLite::Statement query(database, "SELECT * FROM " + table);
      while (query.executeStep()) {
        std::string row;
        for (int i = 0; i < query.getColumnCount(); ++i) row += query.getColumn(i).getString() + "|";
        rows[table].push_back(row);
      }
    }
    return rows;
  }

  static std::string bytes_of(const Path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  static void exec(const Path& log, const std::string& sql) {
    SQLite::Database(log.string(), SQLite::OPEN_READWRITE).exec(sql);
  }

  static void spoil(const Path& file, std::size_t at_byte, std::size_t byte_count) {
    std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
    out.seekp(static_cast<std::streamoff>(at_byte));
    out << std::string(byte_count, '\xA5');
  }
};

TEST_F(Merge, HasEveryRowOfEveryRobotVerifiedAndChangesNoFile) {
  const Path one = robot_log("one.db", 1, 5, 3), two = robot_log("two.db", 2, 2, 7);
  const std::string before = bytes_of(one) + bytes_of(two);
  const log::Merged result = merged({one, two});
  EXPECT_EQ(bytes_of(one) + bytes_of(two), before);
  const Reader reader(path("merged.db"), Check::kWhole);
  EXPECT_TRUE(reader.verification().compared);
  EXPECT_EQ(reader.verification().rows,
            Reader(one, Check::kWhole).verification().rows + Reader(two, Check::kWhole).verification().rows);
  EXPECT_EQ(reader.kicks().size(), 17u);
  const auto counts = table2_of(path("merged.db"));
  for (const auto& [cell, n] : table2_of(one)) EXPECT_EQ(counts.at(cell), n + table2_of(two).at(cell)) << cell;
  const MergeReport report = said(result);
  EXPECT_THAT(report.missing, IsEmpty());
  EXPECT_THAT(report.total, AllOf(HasSubstr("2 sessions of robot 1, robot 2"), HasSubstr("17 kicks")));
  EXPECT_THAT(report.table, AllOf(HasSubstr("one.db"), HasSubstr("two.db")));
}

TEST_F(Merge, OfTheMergedLogAndItsPartsIsTheSameLog) {
  const Path one = robot_log("one.db", 1, 5, 3), two = robot_log("two.db", 2, 2, 7);
  merged({one, two});
  const log::Merged again = merged({one, path("merged.db"), two, two}, "again.db");
  const auto rows = rows_of_all(path("again.db"));
  for (const auto& [table, wanted] : rows_of_all(path("merged.db"))) EXPECT_EQ(rows.at(table), wanted) << table;
  EXPECT_THAT(said(again, "again.db").missing, IsEmpty());
}

TEST_F(Merge, AKickOfTwoRecordersCountsOnce) {
  const Path robot = robot_log("robot.db", 1, 5, 3), base = robot_log("base.db", 1, 5, 3);
  const log::Merged result = merged({robot, base});
  EXPECT_THAT(said(result).total, HasSubstr(", 8 kicks"));
  EXPECT_EQ(table2_of(path("merged.db")), table2_of(robot));
}

TEST_F(Merge, OfTheHalvesOfAMatchIsTheMatch) {
  Path halves[2];
  for (const int half : {1, 2}) {
    log::Session session = of_robot(1);
    session.started_t_ns = half == 1 ? 0 : 60'000 * kMs;
    MatchLog match(path("half" + std::to_string(half) + ".db"), session, options());
    if (half == 2) match.referee(61.0, 2, true);
    match.kicks(half, "on_target", 2 + half);
    match.close();
    halves[half - 1] = path("half" + std::to_string(half) + ".db");
  }
  const log::Merged result = merged({halves[0], halves[1]});
  EXPECT_THAT(result.conflicts, IsEmpty());
  const auto counts = table2_of(path("merged.db"));
  EXPECT_EQ(counts.at("stopped on_target"), 3);
  EXPECT_EQ(counts.at("moving on_target"), 4);
}

TEST_F(Merge, NamesKicksOfWhichTwoRecordersSayDifferentThings) {
  const Path robot = robot_log("robot.db", 1, 5, 3), base = robot_log("base.db", 1, 5, 3);
  exec(base,
       "UPDATE kick_outcomes SET outcome = 'post', on_target = 0 WHERE kick_id = 2;"
       "UPDATE kick_outcomes SET outcome = 'unknown' WHERE kick_id = 3;"
       "UPDATE kick_receipts SET accepted = 0, refusal = 'charging' WHERE kick_id = 4; DELETE FROM digests;"
       "UPDATE sessions SET closed_t_ns = NULL");
  const log::Merged result = merged({robot, base});
  EXPECT_THAT(said(result).conflicts,
              ElementsAre("kick 1:2 (outcome): robot.db says on_target, base.db says post",
                          "kick 1:4 (driver): robot.db says kicked, base.db says refused: charging"));
  EXPECT_THAT(said(result).total, HasSubstr(", 8 kicks"));
  EXPECT_EQ(table2_of(path("merged.db")), table2_of(robot)) << "the more complete recording counts";
  EXPECT_EQ(rows_of_all(path("merged.db")).at("kick_outcomes").size(), 16u) << "both sources are kept";
}

TEST_F(Merge, NamesACopyOfASessionThatSaysSomethingElse) {
  const Path one = robot_log("one.db", 1, 5, 3);
  std::filesystem::copy_file(one, path("copy.db"));
  exec(path("copy.db"), "UPDATE kick_outcomes SET outcome = 'bar', on_target = 0 WHERE kick_id = 1");
  {
    SQLite::Database copy(path("copy.db").string(), SQLite::OPEN_READWRITE);
    log::RowDigests(copy).write(copy.execAndGet("SELECT session_id FROM sessions").getInt64());
  }
  const log::Merged result = merged({one, path("copy.db")});
  EXPECT_THAT(said(result).conflicts, ElementsAre("kick 1:1 (outcome): one.db says on_target, copy.db says bar"));
}

TEST_F(Merge, TakesWhatPeopleSaidOfEveryFileAndIsTheSameAgain) {
  const Path robot = robot_log("robot.db", 1, 5, 3), base = robot_log("base.db", 1, 5, 3);
  const auto say = [&](const Path& log, const std::string& outcome, std::int64_t utc_ns) {
    std::int64_t session_id = 0, t_ns = 0;
    Reader(log).query("SELECT session_id, t_ns FROM kicks WHERE kick_id = 1", [&](std::int64_t of, std::int64_t at) {
      session_id = of;
      t_ns = at;
    });
    log::Additions additions(log);
    additions.add(log::Label{session_id, 1, 1, t_ns, outcome, "Ada", ""}, utc_ns);
    additions.add(log::Note{session_id, "opponent", "Them", "Ada"}, utc_ns);
  };
  say(robot, "over", 1000);
  say(base, "post", 2000);
  const log::Merged result = merged({robot, base});
  EXPECT_THAT(said(result).conflicts, ElementsAre("kick 1:1 (label): robot.db says over, base.db says post"));
  const auto rows = rows_of_all(path("merged.db"));
  EXPECT_EQ(rows.at("labels").size(), 2u);
  EXPECT_EQ(rows.at("notes").size(), 2u);
  EXPECT_EQ(rows.at("tallied_sessions").size(), 2u);
  EXPECT_EQ(make_report(Reader(path("merged.db"))).policies.at(0).of("post"), 1) << "the latest holds";
  merged({path("merged.db"), base, robot, path("merged.db")}, "again.db");
  EXPECT_EQ(rows_of_all(path("again.db")), rows);
}

TEST_F(Merge, SaysFromWhichFileASessionIs) {
  merged({robot_log("one.db", 1, 1, 0), robot_log("two.db", 2, 1, 0)});
  std::vector<std::string> files;
  const Reader reader(path("merged.db"));
  reader.query("SELECT file, row_count FROM merged_sessions JOIN sessions USING (session_id) ORDER BY robot_id",
               [&](const std::string& file, std::int64_t rows) {
                 files.push_back(file);
                 EXPECT_GT(rows, 4);
               });
  EXPECT_THAT(files, ElementsAre("one.db", "two.db"));
}

TEST_F(Merge, OfARecordingAndItsEarlierCopyTheWholeOneIsTaken) {
  const Path early = path("early.db");
  {
    MatchLog match(path("whole.db"), of_robot(1), options());
    match.kicks(1, "on_target", 3);
    match.writer().flush();
    SQLite::Database source(path("whole.db").string());
    SQLite::Statement(source, "VACUUM INTO '" + early.string() + "'").exec();
    match.kicks(1, "over", 2);
    match.close();
  }
  exec(early, "PRAGMA journal_mode = DELETE");
  const log::Merged result = merged({early, path("whole.db")});
  EXPECT_THAT(said(result).missing, IsEmpty());
  EXPECT_EQ(Reader(path("merged.db"), Check::kWhole).kicks().size(), 5u);
  merged({early}, "early_alone.db");
  EXPECT_EQ(Reader(path("early_alone.db")).kicks().size(), 3u);
}

TEST_F(Merge, ASessionThatNeverEndedIsSaid) {
  const Path one = robot_log("one.db", 1, 2, 0);
  exec(one, "UPDATE sessions SET closed_t_ns = NULL; DELETE FROM digests");
  EXPECT_THAT(said(merged({one})).missing, ElementsAre(AllOf(HasSubstr("of robot 1"), HasSubstr("never closed"))));
}

TEST_F(Merge, OfATruncatedFileTakesWhatIsThereAndSaysWhatIsMissing) {
  const Path sound = robot_log("sound.db", 1, 40, 40), cut = robot_log("cut.db", 2, 400, 400);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) * 3 / 4);
  const log::Merged result = merged({sound, cut});
  const Reader reader(path("merged.db"), Check::kWhole);
  EXPECT_THAT(said(result).missing, Contains(HasSubstr("cut.db")));
  EXPECT_GT(rows_of(reader, "kick_decisions WHERE robot_id = 2"), 100);
  EXPECT_EQ(rows_of(reader, "kick_decisions WHERE robot_id = 1"), 80) << "the sound one is whole";
}

TEST_F(Merge, OfADamagedFileTakesWhatLiesBeforeAndBehind) {
  const Path hurt = robot_log("hurt.db", 1, 400, 400);
  const auto byte_count = std::filesystem::file_size(hurt);
  spoil(hurt, byte_count / 2 / 4096 * 4096, 4096);
  EXPECT_ANY_THROW(Reader(hurt, Check::kWhole));
  const log::Merged result = merged({hurt});
  EXPECT_THAT(said(result).missing, Contains(HasSubstr("rows that its recorder had written are not there")));
  const Reader reader(path("merged.db"), Check::kWhole);
  EXPECT_GT(rows_of(reader, "kick_decisions") + rows_of(reader, "kick_outcomes"), 800);
}

TEST_F(Merge, ADamagedFileTakesNothingFromAWholeCopy) {
  const Path one = robot_log("one.db", 1, 400, 400);
  std::filesystem::copy_file(one, path("hurt.db"));
  spoil(path("hurt.db"), std::filesystem::file_size(one) / 2 / 4096 * 4096, 4096);
  merged({path("hurt.db"), one});
  EXPECT_EQ(Reader(path("merged.db"), Check::kWhole).kicks().size(), 800u);
}

TEST_F(Merge, WhatIsNoLogIsSaidAndStopsNobody) {
  std::ofstream(path("other.db")) << "something else";
  const log::Merged result = merged({path("other.db"), path("nowhere.db"), robot_log("one.db", 1, 2, 0)});
  EXPECT_THAT(said(result).missing,
              ElementsAre(AllOf(HasSubstr("other.db"), HasSubstr("nothing of it was taken")), HasSubstr("nowhere.db")));
  EXPECT_THROW(merged({path("other.db")}, "nothing.db"), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(path("nothing.db")));
}

TEST_F(Merge, NeverOverwrites) {
  const Path one = robot_log("one.db", 1, 2, 0), two = robot_log("two.db", 2, 2, 0);
  const std::string before = bytes_of(one);
  EXPECT_THROW(log::merge({one, two}, one), std::runtime_error);
  EXPECT_EQ(bytes_of(one), before);
}

TEST_F(Merge, SkewedClocksComeOutAlignedWithinTheirError) {
  const std::string uuid = log::make_uuid();
  const Path one = robot_log("one.db", 1, 4, 4), two = robot_log("two.db", 2, 4, 4, uuid);
  const std::string id = std::to_string(log::session_id_of(uuid));
  for (const char* const table : {"kick_decisions", "kick_orders", "kick_receipts", "kick_outcomes"})
    exec(two, std::string("UPDATE ") + table + " SET t_ns = t_ns + 50000000");
  exec(two,
       "UPDATE sessions SET closed_t_ns = closed_t_ns + 50000000;"
       "INSERT INTO clock_offsets VALUES (" +
           id + ", 2, 1, 70000000, -49800000, 1000000)");
  SQLite::Database database(two.string(), SQLite::OPEN_READWRITE);
  log::RowDigests(database).write(log::session_id_of(uuid));
  for (const int reference : {1, 2}) {
    const std::string to = "by_" + std::to_string(reference) + ".db";
    const log::Merged result = merged({one, two}, to, reference);
    std::map<std::int64_t, std::map<int, std::int64_t>> utc_ns;
    std::int64_t worst_ns = 0;
    Reader(path(to), Check::kWhole)
        .query("SELECT robot_id, kick_id, utc_ns, error_ns FROM kick_instants",
               [&](int robot_id, std::int64_t kick_id, std::int64_t utc, std::int64_t error_ns) {
                 utc_ns[kick_id][robot_id] = utc;
                 worst_ns = std::max(worst_ns, error_ns);
               });
    ASSERT_EQ(utc_ns.size(), 8u);
    EXPECT_LT(worst_ns, 5 * kMs);
    for (const auto& [kick_id, by_robot] : utc_ns)
      EXPECT_LE(std::abs(by_robot.at(1) - by_robot.at(2)), worst_ns) << kick_id;
    EXPECT_THAT(said(result, to).notes, Contains(HasSubstr("aligned to that of robot " + std::to_string(reference))));
  }
}

TEST_F(Merge, ARobotThatNobodyMeasuredStaysAndIsSaid) {
  const std::string uuid = log::make_uuid();
  const Path two = robot_log("two.db", 2, 1, 0, uuid);
  exec(two, "INSERT INTO clock_offsets VALUES (" + std::to_string(log::session_id_of(uuid)) + ", 2, 1, 20, 0, 1)");
  SQLite::Database database(two.string(), SQLite::OPEN_READWRITE);
  log::RowDigests(database).write(log::session_id_of(uuid));
  const log::Merged result = merged({robot_log("one.db", 1, 1, 0), two, robot_log("three.db", 3, 1, 0)});
  EXPECT_THAT(said(result).notes, Contains(AllOf(HasSubstr("of robot 3"), HasSubstr("stays as it is"))));
}

TEST_F(Merge, ARecorderThatWasGoneIsSaidWithItsKicks) {
  const std::string before = log::make_uuid();
  robot_log("before.db", 1, 2, 0, before);
  log::Session session = of_robot(1);
  session.started_t_ns = 60'000'000'000;
  session.continues_uuid = before;
  session.continued = {{1, 2, 0}};
  {
    MatchLog match(path("after.db"), session, options());
    match.status(5, 0);
    match.close();
  }
  EXPECT_THAT(said(merged({path("before.db"), path("after.db")})).missing,
              ElementsAre(HasSubstr("robot 1: its recorder was gone for 59."),
                          HasSubstr("robot 1: 3 kicks that its driver counted are in no file")));
  EXPECT_THAT(said(merged({path("after.db")}, "alone.db"), "alone.db").missing,
              Contains(HasSubstr("which no file has")));
}

TEST_F(Merge, TheOffsetsThatARecorderNotesAreReadAgain) {
  {
    log::Writer writer(path(), of_robot(3), options());
    log::ClockOffsetWriter offsets(writer);
    EXPECT_TRUE(offsets.push({0, 3, 0, 100, -7, 2}));
    writer.finalise();
  }
  const auto offsets = log::clock_offsets(Reader(path()));
  ASSERT_EQ(offsets.size(), 1u);
  EXPECT_EQ(offsets[0].robot_id, 3);
  EXPECT_EQ(offsets[0].offset_ns, -7);
}

class StoppedWriting : public Merge {
 protected:
  /// Says to stop once the new log is under way.
  auto stop_within(const std::string& name) {
    return [this, name](std::int64_t, std::int64_t) {
      const bool begun = std::filesystem::exists(path(name));
      stopped_ = stopped_ || begun;
      return !begun;
    };
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory_))
      names.push_back(entry.path().filename().string());
    return names;
  }

  bool stopped_ = false;
};

TEST_F(StoppedWriting, OfAMergeLeavesNothing) {
  const Path one = robot_log("one.db", 1, 500, 500), two = robot_log("two.db", 2, 500, 500);
  EXPECT_THROW(log::merge({one, two}, path("out.db"), {{}, stop_within("out.db")}), log::Stopped);
  EXPECT_TRUE(stopped_);
  EXPECT_THAT(files(), testing::UnorderedElementsAre("one.db", "two.db"));
  log::merge({one, two}, path("out.db"));
  EXPECT_EQ(table2_of(path("out.db")).at("stopped on_target"), 1000) << "and nothing stands in the way of the next";
}

TEST(Stoppable, EndsALongStatementAndSaysWhatWentWrongElse) {
  SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  const auto endless = [&] {
    database.execAndGet("WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT count(*) FROM n");
  };
  int asked = 0;
  EXPECT_THROW(log::stoppable(
                   database, [&] { return ++asked < 3; }, endless),
               log::Stopped);
  EXPECT_EQ(asked, 3);
  EXPECT_THROW(log::stoppable(
                   database, []() -> bool { throw std::invalid_argument("asked in vain"); }, endless),
               std::invalid_argument);
  EXPECT_THROW(log::stoppable(
                   database, [] { return true; }, [&] { database.exec("SELECT nothing"); }),
               SQLite::Exception);
  EXPECT_EQ(database.execAndGet("SELECT 1").getInt(), 1);
}

}  // namespace
}  // namespace trivela::evaluator
