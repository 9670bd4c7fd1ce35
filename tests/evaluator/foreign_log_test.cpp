// Logs that somebody else made, or changed, are refused or read right, and never hang.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <chrono>
#include <fstream>
#include <functional>

#include "evaluator/counting/log_kicks.hpp"
#include "evaluator/table2/table2.hpp"
#include "log/file/log_check.hpp"
#include "log/schema/schema_check.hpp"
#include "log/write/experiment_log.hpp"
#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/report_of_log.hpp"

namespace trivela::evaluator {
namespace {

using log::Check;
using log::Reader;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kEndless = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT * FROM n";

class ForeignLog : public LogTest {
 protected:
  ForeignLog() {
    MatchLog match(path(), session(), options());
    match.referee(0.0, 1, true);
    match.kicks(1, "on_target", 5);
    match.kicks(2, "over", 5);
    match.referee(60.0, 1, false);
    match.close();
    report_ = to_text(make_report(Reader(path())));
  }

  /// Statements of somebody else; also such as change the schema's own text.
  void exec(const std::string& sql) const {
    SQLite::Database database(path().string(), SQLite::OPEN_READWRITE);
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_DEFENSIVE, 0, nullptr);
    database.exec("PRAGMA writable_schema = ON; PRAGMA ignore_check_constraints = ON;");
    database.exec(sql);
  }

  /// Replaces a table by what `sql` makes.
  void replace(const std::string& table, const std::string& sql) const {
    exec("ALTER TABLE " + table + " RENAME TO old_" + table + "; " + sql);
  }

  /// What it says, or why it is refused; quickly in any case.
  std::string said(Check check = Check::kIfShort) const {
    const auto begun = std::chrono::steady_clock::now();
    std::string text;
    try {
      text = to_text(make_report(Reader(path(), check)));
    } catch (const std::runtime_error& error) {
      text = error.what();
      EXPECT_THAT(text, HasSubstr(path().string()));
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(60));
    return text;
  }

  std::string report_;
};

TEST_F(ForeignLog, ViewsOfTheFileAreNeverUsed) {
  exec(std::string("DROP VIEW kicks; CREATE VIEW kicks AS ") + kEndless);
  EXPECT_EQ(said(), report_);
}

TEST_F(ForeignLog, AViewInPlaceOfATableIsRefused) {
  replace("odometry", std::string("CREATE VIEW odometry AS ") + kEndless);
  EXPECT_THAT(said(), HasSubstr("its odometry is a view and no table"));
}

TEST_F(ForeignLog, AMissingTableIsNamed) {
  exec("DROP TABLE referee");
  EXPECT_THAT(said(), HasSubstr("it has no table referee"));
}

TEST_F(ForeignLog, AVirtualTableIsRefused) {
  replace("losses", "CREATE VIRTUAL TABLE losses USING fts5(session_id, stream)");
  EXPECT_THAT(said(), HasSubstr("its table losses is not made as in that version"));
}

TEST_F(ForeignLog, AGeneratedColumnIsRefused) {
  exec(
      "UPDATE sqlite_schema SET sql = replace(sql, 'on_target INTEGER NOT NULL CHECK (on_target IN (0, 1)),', "
      "'on_target INTEGER NOT NULL AS (1) VIRTUAL,') WHERE name = 'kick_outcomes'");
  EXPECT_THAT(said(), HasSubstr("its table kick_outcomes is not made as in that version"));
}

TEST_F(ForeignLog, AnotherCollationIsRefused) {
  exec(
      "UPDATE sqlite_schema SET sql = replace(sql, 'refusal TEXT NOT NULL', 'refusal TEXT NOT NULL COLLATE NOCASE') "
      "WHERE name = 'kick_receipts'");
  EXPECT_THAT(said(), HasSubstr("its table kick_receipts is not made as in that version"));
}

TEST_F(ForeignLog, AnIndexOfSomebodyElseOnOurTablesIsRefused) {
  for (const char* const on :
       {"kick_outcomes (outcome)", "kick_outcomes (abs(seq))", "kick_outcomes (seq) WHERE seq > 3"}) {
    exec(std::string("DROP INDEX IF EXISTS mine; CREATE INDEX mine ON ") + on);
    EXPECT_THAT(said(), AllOf(HasSubstr("the index mine on its table kick_outcomes"), HasSubstr("DROP INDEX"))) << on;
  }
}

TEST_F(ForeignLog, AChangedIndexOfOursIsRefused) {
  exec(
      "DROP INDEX kick_receipts_kick; CREATE INDEX kick_receipts_kick ON kick_receipts (session_id, robot_id, kick_id) "
      "WHERE accepted = 1");
  EXPECT_THAT(said(), HasSubstr("its index kick_receipts_kick is not made as in that version"));
}

TEST_F(ForeignLog, AnIndexThatDoesNotSayWhatItsTableSaysIsRefused) {
  exec("UPDATE sqlite_schema SET sql = replace(sql, 'kick_id)', 'seq)') WHERE name = 'kick_outcomes_kick'");
  exec("REINDEX kick_outcomes_kick");
  exec(
      "UPDATE sqlite_schema SET sql = replace(sql, 'robot_id, seq)', 'robot_id, kick_id)') WHERE name = "
      "'kick_outcomes_kick'");
  EXPECT_THAT(said(), HasSubstr("is damaged"));
}

TEST_F(ForeignLog, OtherTablesViewsAndTriggersPlayNoPart) {
  exec(
      std::string("CREATE TABLE jottings (text); CREATE INDEX jottings_text ON jottings (text); CREATE VIEW mine AS ") +
      kEndless +
      "; CREATE TABLE pragma_table_info (arg, name, \"notnull\"); CREATE TABLE words (a); CREATE TABLE heard (a);"
      "CREATE TRIGGER t AFTER INSERT ON referee BEGIN INSERT INTO jottings VALUES ('x'); END;");
  EXPECT_EQ(said(), report_);
  int rows = 0;
  Reader(path()).query("SELECT seq FROM kick_orders", [&](std::int64_t) { ++rows; });
  EXPECT_EQ(rows, 10);
}

TEST_F(ForeignLog, ViewsThatDoubleWithEachOtherCostNothing) {
  std::string sql = "CREATE VIEW v0 AS SELECT 1 AS a;";
  for (int i = 1; i < 60; ++i) {
    const std::string last = "v" + std::to_string(i - 1);
    sql += "CREATE VIEW v" + std::to_string(i) + " AS SELECT x.a FROM " + last + " AS x, " + last + " AS y;";
  }
  exec(sql);
  EXPECT_EQ(said(), report_);
}

TEST_F(ForeignLog, ChecksOfSomebodyElseAreNotRun) {
  exec(
      "UPDATE sqlite_schema SET sql = replace(sql, 'CHECK (fire IN (0, 1))', "
      "'CHECK (length(hex(randomblob(900000000))) > 1)') WHERE name = 'kick_decisions'");
  EXPECT_EQ(said(), report_);
}

TEST_F(ForeignLog, AChangedRowIsRefused) {
  for (const char* const change :
       {"UPDATE kick_outcomes SET outcome = 'on_target' WHERE outcome = 'over'",
        "DELETE FROM kick_orders WHERE kick_id = 1", "UPDATE sessions SET scenario = 'another'",
        "UPDATE losses SET lost = 3 WHERE stream = 'referee'", "UPDATE sessions SET closed_t_ns = NULL",
        "INSERT INTO continued VALUES ((SELECT session_id FROM sessions), 1, 2, 3)",
        "UPDATE digests SET row_count = row_count + 1"}) {
    const auto copy = path("copy.db");
    std::filesystem::copy_file(path(), copy, std::filesystem::copy_options::overwrite_existing);
    exec(change);
    EXPECT_THAT(said(), HasSubstr("are not those that were recorded")) << change;
    EXPECT_EQ(said(Check::kWhole), said()) << change;
    std::filesystem::copy_file(copy, path(), std::filesystem::copy_options::overwrite_existing);
  }
}

TEST_F(ForeignLog, RowsOfNoSessionAreRefused) {
  exec("INSERT INTO referee VALUES (1, 1, 1, 1, 1, 1, 1, 'unknown', 'none', 0, 0, 0, 0, NULL)");
  EXPECT_THAT(said(), HasSubstr("referee has rows of no session"));
}

TEST_F(ForeignLog, AnEndedSessionWithoutItsDigestIsRefused) {
  exec("DELETE FROM digests");
  EXPECT_THAT(said(), HasSubstr("has ended, but the digest of its rows is not there"));
}

TEST_F(ForeignLog, ATextThatIsNotTheNamedOneIsRefused) {
  exec("UPDATE texts SET text = 'b = 1' WHERE text LIKE 'a%'");
  EXPECT_THAT(said(), HasSubstr("has the SHA-256"));
}

TEST_F(ForeignLog, ATextThatIsNotThereIsRefused) {
  exec("DELETE FROM texts WHERE text LIKE 'a%'");
  EXPECT_THAT(said(), HasSubstr("the text that config_sha256 of session"));
}

TEST_F(ForeignLog, WhatIsNotRecordedMayBeAdded) {
  exec("CREATE TABLE verdicts (session_id, label); INSERT INTO verdicts VALUES (1, 'final')");
  EXPECT_EQ(said(Check::kWhole), report_);
}

TEST_F(ForeignLog, AnotherVersionOrKindIsRefused) {
  for (const int version : {2, 7, 8, 1000}) {
    exec("PRAGMA user_version = " + std::to_string(version));
    EXPECT_THAT(said(), HasSubstr("is a match log of version " + std::to_string(version) +
                                  "; this program reads version 1 alone"));
  }
  for (const int version : {0, -1}) {
    exec("PRAGMA user_version = " + std::to_string(version));
    EXPECT_THAT(said(), HasSubstr("is not a match log"));
  }
  exec("PRAGMA user_version = 3; PRAGMA application_id = 0x5343414E");
  EXPECT_THAT(said(), HasSubstr("is not a match log but a scan record"));
}

TEST_F(ForeignLog, PagesOfAnySizeAreReadRight) {
  for (const int page_bytes : {512, 65536}) {
    exec("PRAGMA page_size = " + std::to_string(page_bytes) + "; VACUUM");
    EXPECT_EQ(said(), report_) << page_bytes;
  }
}

TEST_F(ForeignLog, Utf16IsReadRight) {
  std::filesystem::rename(path(), path("utf8.db"));
  SQLite::Database database(path().string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  database.exec("PRAGMA encoding = 'UTF-16le'; PRAGMA application_id = 0x4B49434B; PRAGMA user_version = 1;");
  database.exec(std::string(log::schema_of(log::kMatchLog)));
  SQLite::Database source(path("utf8.db").string());
  for (const std::string& table : log::tables_of(source)) {
    if (table.starts_with("sqlite_")) continue;
    SQLite::Statement rows(source, "SELECT * FROM " + table);
    std::string insert = "INSERT INTO " + table + " VALUES (?";
    for (int i = 1; i < rows.getColumnCount(); ++i) insert += ", ?";
    SQLite::Statement copy(database, insert + ")");
    while (rows.executeStep()) {
      copy.reset();
      for (int i = 0; i < rows.getColumnCount(); ++i) {
        const SQLite::Column cell = rows.getColumn(i);
        if (cell.isInteger()) copy.bind(i + 1, cell.getInt64());
        if (cell.isFloat()) copy.bind(i + 1, cell.getDouble());
        if (cell.isText()) copy.bind(i + 1, cell.getString());
        if (cell.isNull()) copy.bind(i + 1);
      }
      copy.exec();
    }
  }
  EXPECT_EQ(said(), report_);
}

TEST_F(ForeignLog, AWriteAheadLogOfAnotherFileIsRefusedOrIgnored) {
  {
    SQLite::Database other(path("other.db").string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    other.exec(
        "PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 0; CREATE TABLE t (a); "
        "INSERT INTO t VALUES (zeroblob(9000));");
    std::filesystem::copy_file(path("other.db-wal"), path().string() + "-wal");
  }
  const std::string text = said();
  EXPECT_THAT(text, testing::AnyOf(report_, HasSubstr("is damaged"), HasSubstr("is not a match log"),
                                   HasSubstr("cannot read")));
}

TEST_F(ForeignLog, ATextOfAbsurdLengthIsRefused) {
  exec("INSERT INTO texts VALUES ('x', CAST(zeroblob(40000000) AS TEXT))");
  EXPECT_THAT(said(), HasSubstr(path().string()));
}

TEST_F(ForeignLog, APromiseOfAGigabyteInASmallFileIsRefused) {
  exec("CREATE TABLE promise (a); INSERT INTO promise VALUES (zeroblob(20))");
  // The blob's serial type, 2 * 20 + 12 as one byte, becomes 2 * 10^9 + 12 as five.
  SQLite::Database database(path().string(), SQLite::OPEN_READONLY);
  const int page = database.execAndGet("SELECT rootpage FROM sqlite_schema WHERE name = 'promise'").getInt();
  const int page_bytes = database.execAndGet("PRAGMA page_size").getInt();
  std::fstream file(path(), std::ios::binary | std::ios::in | std::ios::out);
  const std::string cell("\x17\x01\x06\x87\xBB\xB9\xCA\x0C", 8);  // payload of 23 bytes, rowid 1, header of 6
  file.seekp(static_cast<std::streamoff>(page) * page_bytes - 24);
  file.write(cell.data(), static_cast<std::streamsize>(cell.size()));
  file.close();
  const std::string text = said();
  EXPECT_THAT(text, testing::AnyOf(report_, HasSubstr("damaged")));
}

TEST_F(ForeignLog, AnExperimentOfSomebodyElseIsGoneOnWithOnlyWhereItsSchemaIsOurs) {
  const auto other = path("experiment.db");
  { log::ExperimentLog experiment(other, {"a", 2}); }
  SQLite::Database(other.string(), SQLite::OPEN_READWRITE).exec("CREATE INDEX mine ON kick_outcomes (outcome)");
  try {
    log::ExperimentLog again(other, {"a", 2});
    FAIL() << "gone on with";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("the index mine on its table kick_outcomes"));
  }
}

TEST_F(ForeignLog, ALongLogSaysThatItIsNotVerifiedAndIsOnRequest) {
  EXPECT_THAT(said(Check::kQuick), AllOf(HasSubstr("not verified: "), HasSubstr("trivela report --verify")));
  exec("UPDATE kick_outcomes SET exit_speed_mps = 4 WHERE kick_id = 1");
  EXPECT_THAT(said(Check::kQuick), HasSubstr("not verified"));
  EXPECT_THAT(said(Check::kWhole), HasSubstr("are not those that were recorded"));
}

TEST_F(ForeignLog, NothingInItReachesATerminalRaw) {
  const auto other = path("escapes.db");
  log::Session session = LogTest::session();
  session.scenario = "red \x1b[31m\nTable 2: \xc2\x9b right-to-left \u202e";
  session.software_version = "0.1\x07\xff";
  {
    MatchLog match(other, session, options());
    match.kicks(1, "on_target", 1);
  }
  const Report report = make_report(Reader(other));
  const std::string text = to_text(report);
  EXPECT_THAT(text, HasSubstr("'red \\x1b[31m\\x0aTable 2: \\xc2\\x9b right-to-left \\xe2\\x80\\xae'"));
  EXPECT_THAT(text, HasSubstr("version 0.1\\x07\\xff"));
  const std::string json = to_json(report);
  EXPECT_THAT(json, HasSubstr("red \\u001b[31m\\nTable 2: \\u009b right-to-left \\u202e"));
  for (const std::string& shown : {text, json, to_csv(report)}) {
    for (const char c : shown) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << static_cast<int>(c);
  }
}

}  // namespace
}  // namespace trivela::evaluator
