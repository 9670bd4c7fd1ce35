// What `trivela export` writes: CSV against SQLite, bit for bit; names and members of the messages; what is left when
// it is stopped.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>

#include "evaluator/export/export_files.hpp"
#include "evaluator/mcap/messages.hpp"
#include "log/schema/schema.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::evaluator {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

const log::StreamTable& table(const std::string& name) {
  return *std::ranges::find(log::stream_tables(), name, &log::StreamTable::name);
}

/// Cells of the lines of a CSV file; a cell in quotes keeps them.
std::vector<std::vector<std::string>> cells_of(const fs::path& path) {
  std::ifstream in(path);
  std::vector<std::vector<std::string>> rows{{""}};
  bool quoted = false;
  for (char c = 0; in.get(c);) {
    if (c == '"') quoted = !quoted;
    if (!quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!quoted && c == '\n') {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

class Export : public LogTest {
 protected:
  static constexpr double kHard[] = {-0.0, 5e-324, 1.7976931348623157e308, 0.1, 1.0 / 3.0, 9007199254740993.0, 1e21};

  void write_log() {
    MatchLog match(path(), session(), options());
    match.kicks(1, "on_target", 3);
    match.referee(1.0, 1, true);
    const auto drives = drive_table(match.writer());
    std::int64_t seq = 0;
    for (const double hard : kHard) match.writer().push(drives, drive_row(++seq, hard));
    std::uint64_t state = 7;
    for (int i = 0; i < 500; ++i) {  // any bits that are a finite number
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      const auto number = std::bit_cast<double>(state);
      if (std::isfinite(number)) match.writer().push(drives, drive_row(++seq, number));
    }
    match.close();
  }
};

TEST_F(Export, CsvHoldsEveryCellToTheBit) {
  write_log();
  const log::Reader reader(path());
  const ExportedRows written = export_csv(reader, {}, path("csv"));
  const SQLite::Database database(path().string(), SQLite::OPEN_READONLY);
  std::size_t compared = 0;
  for (const log::StreamTable& stream : log::stream_tables()) {
    SQLite::Statement query(database, "SELECT * FROM " + stream.name + " ORDER BY " + stream.key);
    if (!fs::exists(path("csv") / (stream.name + ".csv"))) {
      EXPECT_FALSE(query.executeStep()) << stream.name;
      continue;
    }
    const auto rows = cells_of(path("csv") / (stream.name + ".csv"));
    ASSERT_EQ(static_cast<std::int64_t>(rows.size()) - 1, written.at(stream.name));
    for (std::size_t i = 1; i < rows.size(); ++i) {
      ASSERT_TRUE(query.executeStep());
      for (int c = 0; c < query.getColumnCount(); ++c, ++compared) {
        const std::string& cell = rows[i].at(static_cast<std::size_t>(c));
        const SQLite::Column column = query.getColumn(c);
        ASSERT_EQ(rows[0][static_cast<std::size_t>(c)], column.getName());
        if (column.isNull()) {
          EXPECT_EQ(cell, "");
        } else if (column.isFloat()) {
          double number = 0.0;
          std::from_chars(cell.data(), cell.data() + cell.size(), number);
          EXPECT_EQ(std::bit_cast<std::uint64_t>(number), std::bit_cast<std::uint64_t>(column.getDouble())) << cell;
        } else if (column.isInteger()) {
          EXPECT_EQ(cell, std::to_string(column.getInt64()));
        } else {
          EXPECT_EQ(cell, column.getString().empty() ? "\"\"" : column.getString());
        }
      }
    }
    EXPECT_FALSE(query.executeStep());
  }
  EXPECT_GT(compared, 3000u);
}

TEST(CsvCell, TellsNullFromTheEmptyTextAndQuotesWhatNeedsIt) {
  const auto cell = [](const log::Value& value) {
    std::string line;
    append_csv_cell(line, value);
    return line;
  };
  EXPECT_EQ(cell({}), "");
  EXPECT_EQ(cell(std::string()), "\"\"");
  EXPECT_EQ(cell(std::string("a, \"b\"\n")), "\"a, \"\"b\"\"\\x0a\"");
  EXPECT_EQ(cell(std::string("=cmd()")), "'=cmd()");
  EXPECT_EQ(cell(std::string("\x1b[31m")), "\\x1b[31m");
  EXPECT_EQ(cell(std::string("plain")), "plain");
  EXPECT_EQ(cell(-0.0), "-0");
  EXPECT_EQ(cell(std::int64_t{-9223372036854775807 - 1}), "-9223372036854775808");
}

TEST_F(Export, WritesOnlyTheStreamsAndSessionsThatAreAskedFor) {
  write_log();
  const log::Reader reader(path());
  const std::string uuid = reader.sessions().front().uuid;
  EXPECT_THAT(export_csv(reader, {{"kick_orders"}, {uuid.substr(0, 6)}}, path("one")),
              testing::ElementsAre(testing::Pair("kick_orders", 3)));
  EXPECT_EQ(std::distance(fs::directory_iterator(path("one")), {}), 1);
  EXPECT_THROW(export_csv(reader, {{"kicks"}, {}}, path("two")), BadExport);
  EXPECT_THROW(export_csv(reader, {{}, {"no"}}, path("two")), BadExport);
  EXPECT_FALSE(fs::exists(path("two")));
}

TEST_F(Export, LeavesNothingWhereItIsStopped) {
  {
    MatchLog match(path(), session(), options());
    match.kicks(1, "short", 2000);
    match.close();
  }
  const log::Reader reader(path());
  const auto stop = [](std::int64_t) { return false; };
  EXPECT_THROW(export_csv(reader, {}, path("csv"), stop), ExportStopped);
  EXPECT_THROW(export_mcap(reader, {}, path("log.mcap"), "test", stop), ExportStopped);
  std::vector<fs::path> there;
  for (const auto& entry : fs::directory_iterator(directory_)) there.push_back(entry.path().filename());
  EXPECT_THAT(there, testing::ElementsAre("match.db"));
  EXPECT_EQ(export_csv(reader, {}, path("csv")).at("kick_outcomes"), 2000);  // the reader is as it was
}

TEST_F(Export, AFileThatCannotBeWrittenIsNamed) {
  write_log();
  const log::Reader reader(path());
  const auto said = [](auto&& work) -> std::string {
    try {
      work();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_THAT(said([&] { export_csv(reader, {}, path("no/csv")); }), HasSubstr("no/csv"));
  EXPECT_THAT(said([&] { export_mcap(reader, {}, path("no/log.mcap"), "test"); }), HasSubstr("no/log.mcap"));
  EXPECT_THAT(said([] { mcap::Writer("/dev/full", "test").close(); }), HasSubstr("cannot write /dev/full: No space"));
}

TEST_F(Export, AnEmptyLogIsAFileWithItsSessionAlone) {
  {
    log::Writer writer(path(), session(), options());
    writer.finalise();
  }
  const log::Reader reader(path());
  EXPECT_THAT(export_mcap(reader, {}, path("log.mcap"), "test"),
              testing::ElementsAre(testing::Pair("session_policies", 2), testing::Pair("sessions", 1),
                                   testing::Pair("tallied_sessions", 1)));
}

TEST(StreamTables, AreTheSchemasOwn) {
  SQLite::Database empty(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  empty.exec(std::string(log::schema_of(log::kMatchLog)));
  for (const log::StreamTable& stream : log::stream_tables()) {
    const auto columns = log::columns_of(empty, stream.name);
    ASSERT_TRUE(columns);
    ASSERT_EQ(columns->size(), stream.columns.size()) << stream.name;
    EXPECT_NE(stream.meaning, "") << stream.name;
    for (std::size_t i = 0; i < columns->size(); ++i) {
      EXPECT_EQ((*columns)[i].name, stream.columns[i].name);
      EXPECT_NE(stream.columns[i].meaning, "") << stream.name << "." << stream.columns[i].name;
    }
  }
  const auto& decisions = table("kick_decisions").columns;
  const auto column = [&](const char* name) { return *std::ranges::find(decisions, name, &log::StreamColumn::name); };
  EXPECT_EQ(column("fire").kind, log::CellKind::kTruth);
  EXPECT_EQ(column("power").kind, log::CellKind::kNumber);
  EXPECT_TRUE(column("power").may_be_null);
  EXPECT_THAT(column("policy").labels, IsEmpty()) << "it may be any program's";
  EXPECT_EQ(column("reason").labels.front(), "fire");
  EXPECT_THAT(table("sessions").columns.at(1).labels, IsEmpty());
  EXPECT_EQ(table("kick_decisions").key, "session_id, robot_id, seq");
  EXPECT_FALSE(table("shadow_decisions").is_of_robots());
}

TEST(RowMessages, AreNamedLikeTheMessagesOfTheBus) {
  std::set<std::string> names;
  for (const log::StreamTable& stream : log::stream_tables()) {
    const std::string type = mcap::schema_of(stream).name;
    EXPECT_TRUE(names.insert(type).second) << type;
    const std::string name = type.substr(std::string("trivela_msgs/msg/").size());
    if (stream.is_of_robots()) {
      EXPECT_EQ(log::table_of_message(name), stream.name);
    }
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"trivela_msgs/msg/Loss", "trivela_msgs/msg/SessionPolicy"}));
}

TEST(RowMessages, AreCdrAsWrittenByHand) {
  const log::StreamTable stream{"toys",
                                "session_id",
                                "toys",
                                {{"session_id", log::CellKind::kInteger, false, {}, "a"},
                                 {"on", log::CellKind::kTruth, false, {}, "b"},
                                 {"x_m", log::CellKind::kNumber, true, {}, "c"},
                                 {"end_t_ns", log::CellKind::kInteger, true, {}, "d"},
                                 {"kind", log::CellKind::kLabel, false, {"soft", "hard"}, "e"},
                                 {"name", log::CellKind::kText, false, {}, "f"}}};
  EXPECT_EQ(mcap::schema_of(stream).name, "trivela_msgs/msg/Toy");
  EXPECT_EQ(mcap::schema_of(stream).text,
            "# toys\nint64 session_id  # a\nbool on  # b\nfloat64 x_m  # c\nbool has_end_t_ns\nint64 end_t_ns  # d\n"
            "uint8 KIND_SOFT=0\nuint8 KIND_HARD=1\nuint8 KIND_OTHER_LABEL=255\nuint8 kind  # e\nstring name  # f\n");
  mcap::Cdr cdr;
  mcap::write_row(
      cdr, stream,
      std::vector<log::Value>{std::int64_t{258}, std::int64_t{1}, 1.0, {}, std::string("hard"), std::string("hi")});
  const std::string wanted(
      "\0\1\0\0"
      "\2\1\0\0\0\0\0\0"
      "\1\0\0\0\0\0\0\0"
      "\0\0\0\0\0\0\xF0\x3F"
      "\0\0\0\0\0\0\0\0"
      "\0\0\0\0\0\0\0\0"
      "\1\0\0\0"
      "\3\0\0\0hi\0",
      55);
  EXPECT_EQ(cdr.bytes(), wanted);
  mcap::write_row(cdr, stream,
                  std::vector<log::Value>{
                      std::int64_t{0}, std::int64_t{0}, {}, std::int64_t{5}, std::string("new"), std::string()});
  EXPECT_EQ(static_cast<unsigned char>(cdr.bytes()[4 + 40]), mcap::kOtherLabel);
  EXPECT_THROW(mcap::write_row(cdr, stream, std::vector<log::Value>(6)), log::WrongCell);
}

TEST_F(Export, RowsOfSeveralRobotsAreOneSequenceInTime) {
  {
    MatchLog match(path(), session(), options());
    for (int i = 0; i < 20; ++i) {
      match.robot_id = 1 + i % 3;
      match.kick(1, "short");
    }
    match.close();
  }
  const log::Reader reader(path());
  EXPECT_THAT(reader.robots_in("kick_orders", reader.sessions().front().session_id), testing::ElementsAre(1, 2, 3));
  std::vector<log::TimedPart> parts;
  for (const int robot : {3, 1, 2})
    parts.push_back(
        {"kick_orders", {"t_ns"}, "session_id, robot_id, seq", reader.sessions().front().session_id, robot});
  std::vector<std::int64_t> instants;
  reader.for_each_row_in_time(
      parts, [](std::size_t, std::span<const log::Value> row) { return std::get<std::int64_t>(row[0]); },
      [&](std::size_t, std::int64_t t_ns, std::span<const log::Value>) { instants.push_back(t_ns); });
  EXPECT_EQ(instants.size(), 20u);
  EXPECT_TRUE(std::ranges::is_sorted(instants));
}

}  // namespace
}  // namespace trivela::evaluator
