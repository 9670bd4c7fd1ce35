#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <functional>
#include <optional>

#include "tests/evaluator/log_fixture.hpp"

namespace trivela::evaluator {
namespace {

using log::NamedCells;
using log::Reader;
using log::Value;
using log::Writer;
using testing::HasSubstr;

class LogReader : public LogTest {
 protected:
  std::string message_of_opening(const std::string& name = "match.db") const {
    try {
      Reader reader(path(name));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  void write_log(std::int64_t rows = 1) {
    Writer writer(path(), session(), options());
    const auto referee = referee_table(writer);
    for (std::int64_t seq = 0; seq < rows; ++seq) writer.push(referee, referee_row(seq));
  }
};

TEST_F(LogReader, ALogIsKnownByItsApplicationIdAndVersion) {
  write_log();
  SQLite::Database database(path().string());
  EXPECT_EQ(database.execAndGet("PRAGMA application_id").getInt(), 0x4B49434B);
  EXPECT_EQ(database.execAndGet("PRAGMA user_version").getInt(), 1);
  EXPECT_EQ(database.execAndGet("PRAGMA journal_mode").getString(), "delete");
}

TEST_F(LogReader, AMissingFileIsNamed) { EXPECT_THAT(message_of_opening(), HasSubstr("there is no match log")); }

TEST_F(LogReader, OtherFilesAreNotMatchLogs) {
  std::ofstream(path("garbage.db")) << std::string(8192, 'x');
  SQLite::Database(path("other.db").string(), SQLite::OPEN_CREATE | SQLite::OPEN_READWRITE).exec("CREATE TABLE t (a)");
  for (const char* const name : {"garbage.db", "other.db"}) {
    EXPECT_THAT(message_of_opening(name), HasSubstr("is not a match log")) << name;
  }
}

TEST_F(LogReader, AnEmptyFileIsCalledEmpty) {
  std::ofstream(path("empty.db")).close();
  EXPECT_THAT(message_of_opening("empty.db"), testing::EndsWith("empty.db is empty, no match log"));
}

TEST_F(LogReader, ALogThatSqliteCallsMalformedNamesWhoSaysWhatCanBeDone) {
  write_log(20'000);
  std::filesystem::resize_file(path(), std::filesystem::file_size(path()) / 2);
  EXPECT_THAT(message_of_opening(),
              testing::EndsWith("malformed: trivela doctor " + path().string() + " says what can be done"));
}

TEST_F(LogReader, ANewerLogIsRefusedWithBothVersions) {
  write_log();
  SQLite::Database(path().string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 9");
  EXPECT_THAT(message_of_opening(), HasSubstr("of version 9; this program reads version 1 alone"));
}

TEST_F(LogReader, ATruncatedLogIsDamagedWhereverItEnds) {
  write_log(3000);
  const auto size = std::filesystem::file_size(path());
  const auto copy = path("short.db");
  for (const double part : {0.95, 0.7, 0.5, 0.2, 0.05}) {
    std::filesystem::copy_file(path(), copy, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(copy, static_cast<std::uintmax_t>(part * static_cast<double>(size)));
    EXPECT_THAT(message_of_opening("short.db"),
                testing::AnyOf(HasSubstr("is damaged"), HasSubstr("is not a match log")))
        << part;
  }
}

TEST_F(LogReader, ACopyWithoutItsWriteAheadLogIsWarnedAbout) {
  Writer writer(path(), session(), options());
  writer.push(referee_table(writer), referee_row(1));
  writer.flush();
  std::filesystem::copy_file(path(), path("copy.db"));
  std::filesystem::copy_file(path("match.db-wal"), path("copy.db-wal"));
  EXPECT_EQ(rows_of(Reader(path("copy.db")), "referee"), 1);
  EXPECT_THAT(Reader(path("copy.db")).warnings().at(0), HasSubstr("still runs or was killed"));

  std::filesystem::copy_file(path(), path("half.db"));
  const Reader half(path("half.db"));
  EXPECT_EQ(rows_of(half, "referee"), 0);
  EXPECT_THAT(half.warnings().at(0), HasSubstr("no -wal lies beside it"));
}

TEST_F(LogReader, NeverWrites) {
  write_log();
  const Reader reader(path());
  EXPECT_THROW(reader.query("DELETE FROM referee", [](std::span<const Value>) {}), std::runtime_error);
  EXPECT_EQ(rows_of(reader, "referee"), 1);
}

TEST_F(LogReader, UnknownTablesAndColumnsAreNamed) {
  write_log();
  const Reader reader(path());
  const auto nothing = [](std::span<const Value>) {};
  EXPECT_THROW(reader.for_each_row_between("wheels", {"seq"}, {}, nothing), std::runtime_error);
  EXPECT_THROW(reader.for_each_row_between("referee", {"whistle"}, {}, nothing), std::runtime_error);
  EXPECT_THROW(reader.query("SELECT whistle FROM referee", nothing), std::runtime_error);
}

std::string message_of(const std::function<void()>& read) {
  try {
    read();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST_F(LogReader, GivesTheColumnsOfARowByTypeAndName) {
  write_log(2);
  const Reader reader(path());
  for (const char* const columns : {"seq, 0.5 AS number, 3 AS whole, 'on' AS text, NULL AS missing, 1 AS yes",
                                    "1 AS yes, NULL AS missing, 'on' AS text, seq, 3 AS whole, 0.5 AS number"}) {
    int rows = 0;
    reader.query(fmt::format("SELECT {} FROM referee ORDER BY seq", columns), [&](const NamedCells& row) {
      EXPECT_EQ(row.get<std::int64_t>("seq"), rows++);
      EXPECT_EQ(row.get<double>("number"), 0.5);
      EXPECT_EQ(row.get<double>("whole"), 3.0);
      EXPECT_EQ(row.get<std::string>("text"), "on");
      EXPECT_FALSE(row.find<double>("missing"));
      EXPECT_FALSE(row.find<std::string>("missing"));
      EXPECT_EQ(row.find<int>("whole"), 3);
      EXPECT_TRUE(row.get<bool>("yes"));
      EXPECT_THROW(row.get<int>("whistle"), std::logic_error);
    });
    EXPECT_EQ(rows, 2) << columns;
  }
}

TEST_F(LogReader, GivesAFewColumnsInTheirOrder) {
  write_log(2);
  int rows = 0;
  Reader(path()).query("SELECT seq, 0.5, NULL FROM referee ORDER BY seq",
                       [&](std::int64_t seq, double number, std::optional<int> nothing) {
                         EXPECT_EQ(seq, rows++);
                         EXPECT_EQ(number, 0.5);
                         EXPECT_FALSE(nothing);
                       });
  EXPECT_EQ(rows, 2);
}

TEST_F(LogReader, NamesTheColumnOfACellOfAnotherType) {
  write_log(1);
  const Reader reader(path());
  try {
    reader.query("SELECT 'on' AS power FROM referee", [](const NamedCells& row) { row.get<double>("power"); });
    FAIL() << "a text is no number";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("column power"));
  }
}

TEST_F(LogReader, GivesRowsAsStructs) {
  struct Word {
    std::string text;
    std::optional<double> number;
  };
  write_log();
  const Reader reader(path());
  const auto words = reader.rows<Word>("SELECT 1.5, 'a' UNION ALL SELECT NULL, 'b'", &Word::number, &Word::text);
  ASSERT_EQ(words.size(), 2u);
  EXPECT_EQ(words[0].text, "a");
  EXPECT_EQ(words[0].number, 1.5);
  EXPECT_EQ(words[1].text, "b");
  EXPECT_FALSE(words[1].number);
}

TEST_F(LogReader, ACellOfAnotherTypeIsNamedWithItsQueryAndColumn) {
  write_log();
  const Reader reader(path());
  const auto text_of_a_number =
      message_of([&] { reader.query("SELECT seq AS word FROM referee", [](const std::string&) {}); });
  EXPECT_THAT(text_of_a_number, HasSubstr("match.db"));
  EXPECT_THAT(text_of_a_number, HasSubstr("column word of \"SELECT seq AS word FROM referee\" is not a text"));
  const auto read = [&](const std::string& sql, auto fn) { return message_of([&] { reader.query(sql, fn); }); };
  EXPECT_THAT(read("SELECT NULL AS power", [](double) {}), HasSubstr("column power"));
  EXPECT_THAT(read("SELECT 'x' AS power", [](std::optional<double>) {}), HasSubstr("column power"));
  EXPECT_THAT(read("SELECT 0.5 AS half", [](int) {}), HasSubstr("column half"));
  EXPECT_THAT(read("SELECT 5000000000 AS robot_id", [](int) {}), HasSubstr("column robot_id"));
  EXPECT_THROW(reader.query("SELECT 1, 2", [](int) {}), std::logic_error);
}

}  // namespace
}  // namespace trivela::evaluator
