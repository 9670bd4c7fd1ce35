#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <latch>
#include <limits>
#include <thread>

#include "log/file/new_file.hpp"
#include "log/schema/digest.hpp"
#include "tests/evaluator/log_fixture.hpp"

namespace trivela::evaluator {
namespace {

using log::Reader;
using log::Value;
using log::Writer;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using LogWriter = LogTest;

int drives_in(const std::filesystem::path& log) {
  int rows = 0;
  Reader(log).query("SELECT vx_mps FROM drive_commands", [&](double) { ++rows; });
  return rows;
}

TEST_F(LogWriter, WritesRowsThatAreReadBackInOrder) {
  {
    Writer writer(path(), session(), options());
    const auto drive = drive_table(writer);
    for (std::int64_t seq : {3, 1, 2}) EXPECT_TRUE(writer.push(drive, drive_row(seq, 0.5 * static_cast<double>(seq))));
    writer.finalise();
    EXPECT_EQ(writer.stats().rows_written, 3);
  }
  std::vector<double> speeds;
  Reader(path()).query("SELECT vx_mps FROM drive_commands ORDER BY session_id, robot_id, seq",
                       [&](double vx_mps) { speeds.push_back(vx_mps); });
  EXPECT_THAT(speeds, ElementsAre(0.5, 1.0, 1.5));
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(LogWriter, ASessionMayTurnOutToBeSimulated) {
  log::Session real = session();
  real.simulated = false;
  real.seed.reset();
  real.scenario.clear();
  Writer writer(path(), real, options());
  EXPECT_TRUE(writer.simulated({}));
  writer.flush();
  auto recorded = Reader(path()).sessions().at(0);
  EXPECT_TRUE(recorded.simulated) << "at once, not at the end";
  EXPECT_FALSE(recorded.seed);
  EXPECT_TRUE(
      writer.simulated(log::Simulation{.seed = 9, .scenario = "hall", .paired_halves = true, .planned_s = 60.0}));
  EXPECT_TRUE(writer.simulated(log::Simulation{.seed = {}, .scenario = "hall", .paired_halves = true}));
  writer.finalise();
  recorded = Reader(path()).sessions().at(0);
  EXPECT_EQ(recorded.seed, 9) << "what is not known takes nothing away";
  EXPECT_EQ(recorded.scenario, "hall");
  EXPECT_TRUE(recorded.paired_halves);
}

TEST_F(LogWriter, TheSessionIsWrittenWholeAndClosed) {
  {
    Writer writer(path(), session(), options());
    writer.push(referee_table(writer), referee_row(5, 1, 4711));
    writer.finalise();
  }
  const auto sessions = Reader(path()).sessions();
  ASSERT_THAT(sessions, SizeIs(1));
  const auto& recorded = sessions[0];
  EXPECT_EQ(recorded.session_id, log::session_id_of(recorded.uuid));
  EXPECT_EQ(recorded.robot_id, 1);
  EXPECT_EQ(recorded.started_t_ns, 20);
  EXPECT_EQ(recorded.closed_t_ns, 4711) << "the latest t_ns of the rows";
  EXPECT_TRUE(recorded.simulated_clock);
  EXPECT_EQ(recorded.config_sha256, log::sha256("a = 1\n"));
  EXPECT_EQ(recorded.seed, 7);
  EXPECT_EQ(recorded.scenario, "empty_field");
  ASSERT_THAT(recorded.policies, SizeIs(2));
  EXPECT_EQ(recorded.policies[1].half, 2);
  EXPECT_EQ(recorded.policies[1].policy, "moving");
}

TEST_F(LogWriter, FinaliseLeavesOneFile) {
  Writer writer(path(), session(), options());
  writer.push(referee_table(writer), referee_row(1));
  writer.flush();
  EXPECT_TRUE(std::filesystem::exists(path("match.db-wal")));
  writer.finalise(99);
  EXPECT_FALSE(std::filesystem::exists(path("match.db-wal")));
  EXPECT_FALSE(std::filesystem::exists(path("match.db-shm")));
  EXPECT_EQ(Reader(path()).sessions().at(0).closed_t_ns, 99);
}

TEST_F(LogWriter, FinaliseWhileSomebodyReadsKeepsEverything) {
  auto writer = std::make_unique<Writer>(path(), session(), options());
  writer->push(referee_table(*writer), referee_row(1));
  writer->flush();
  const Reader early(path());
  std::int64_t seen = 0;
  early.query("SELECT seq FROM referee", [&](std::int64_t) {  // holds its snapshot meanwhile
    writer->finalise();
    ++seen;
  });
  EXPECT_EQ(seen, 1);
  EXPECT_THAT(warnings_, SizeIs(1));
  writer.reset();
  EXPECT_TRUE(Reader(path()).sessions().at(0).closed_t_ns);
}

TEST_F(LogWriter, TheDestructorFinalises) {
  {
    Writer writer(path(), session(), options());
    writer.push(referee_table(writer), referee_row(1));
  }
  const Reader reader(path());
  EXPECT_EQ(rows_of(reader, "referee"), 1);
  EXPECT_THAT(reader.warnings(), IsEmpty());
}

TEST_F(LogWriter, NanIsNullWhereTheMessageMayHaveNone) {
  {
    Writer writer(path(), session(), options());
    const auto flight = writer.table(
        "flight_frames", {"robot_id", "seq", "t_ns", "t_exposure_ns", "ball_seen", "ball_x_m", "ball_y_m", "ball_z_m"});
    using Int = std::int64_t;
    writer.push(flight, {Int{1}, Int{1}, Int{20}, Int{10}, Int{0}, kNan, kNan, std::monostate{}});
  }
  int nulls = 0;
  Reader(path()).query("SELECT ball_x_m, ball_z_m FROM flight_frames", [&](std::span<const Value> row) {
    for (const Value& value : row) nulls += std::holds_alternative<std::monostate>(value) ? 1 : 0;
  });
  EXPECT_EQ(nulls, 2);
}

TEST_F(LogWriter, NanInfinityAndNothingAreCountedWhereANumberMustBeAndAreNeverFatal) {
  {
    Writer writer(path(), session(), options());
    const auto drive = drive_table(writer);
    writer.push(drive, drive_row(1, kNan));
    writer.push(drive, drive_row(2, kInfinity));
    writer.push(drive, drive_row(3, -kInfinity));
    auto nothing = drive_row(4, 0.0);
    nothing[3] = std::monostate{};
    writer.push(drive, nothing);
    writer.push(drive, drive_row(5, 1.0));
    writer.flush();
    EXPECT_EQ(writer.health(), std::nullopt);
    EXPECT_EQ(writer.stats().rows_missing, 4);
  }
  const Reader reader(path());
  EXPECT_EQ(rows_of(reader, "drive_commands"), 1);
  EXPECT_EQ(loss_of(reader, "drive_commands").nan_refused, 4);
  EXPECT_EQ(loss_of(reader, "drive_commands").received, 5);
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("drive_commands: NaN")));
}

TEST_F(LogWriter, InfinityIsRefusedInANullableColumnToo) {
  {
    Writer writer(path(), session(), options());
    const auto flight = writer.table(
        "flight_frames", {"robot_id", "seq", "t_ns", "t_exposure_ns", "ball_seen", "ball_x_m", "ball_y_m", "ball_z_m"});
    using Int = std::int64_t;
    writer.push(flight, {Int{1}, Int{1}, Int{20}, Int{10}, Int{0}, kInfinity, kNan, kNan});
  }
  EXPECT_EQ(loss_of(Reader(path()), "flight_frames").nan_refused, 1);
}

TEST_F(LogWriter, RowsAgainstTheSchemaAreCountedAndTheOthersWritten) {
  {
    Writer writer(path(), session(), options());
    const auto referee = referee_table(writer);
    writer.push(referee, referee_row(1));
    writer.push(referee, referee_row(1));  // same key
    auto wrong = referee_row(2);
    wrong[4] = std::int64_t{2};  // playing is 0 or 1
    writer.push(referee, wrong);
    wrong = referee_row(3);
    wrong[3] = std::string("first");  // half is a number
    writer.push(referee, wrong);
    writer.push(referee, {std::int64_t{1}});  // too few
    writer.push(referee, referee_row(4));
  }
  const Reader reader(path());
  EXPECT_EQ(rows_of(reader, "referee"), 2);
  EXPECT_EQ(loss_of(reader, "referee").rejected, 4);
  EXPECT_EQ(loss_of(reader, "referee").missing(), 4);
  EXPECT_THAT(reader.warnings(), ElementsAre(HasSubstr("referee: 4 rows are missing")));
}

TEST_F(LogWriter, AFullQueueRefusesAndCounts) {
  std::size_t refused = 0;
  {
    Writer writer(path(), session(), options(8, 0.01));
    const auto referee = referee_table(writer);
    for (std::int64_t seq = 0; seq < 20000; ++seq) refused += writer.push(referee, referee_row(seq)) ? 0 : 1;
    EXPECT_LE(writer.stats().queue_high_water, 8u);
    writer.flush();
    EXPECT_EQ(writer.stats().rows_missing, static_cast<std::int64_t>(refused));
  }
  const Reader reader(path());
  EXPECT_GT(refused, 0u);
  EXPECT_EQ(loss_of(reader, "referee").overflow, static_cast<std::int64_t>(refused));
  EXPECT_EQ(rows_of(reader, "referee") + static_cast<std::int64_t>(refused), 20000);
}

TEST_F(LogWriter, RowsOfOneSpanShareACommit) {
  Writer writer(path(), session(), options(65536, 3600.0));
  const auto referee = referee_table(writer);
  for (std::int64_t seq = 0; seq < 1000; ++seq) writer.push(referee, referee_row(seq));
  EXPECT_EQ(writer.stats().commits, 0);
  writer.flush();
  EXPECT_EQ(writer.stats().rows_written, 1000);
  EXPECT_LE(writer.stats().commits, 2) << "the flush may meet the writer between two groups";
}

TEST_F(LogWriter, AHalfFullQueueIsWrittenBeforeTheSpanEnds) {
  Writer writer(path(), session(), options(64, 3600.0));
  const auto referee = referee_table(writer);
  for (std::int64_t seq = 0; seq < 32; ++seq) writer.push(referee, referee_row(seq));
  while (writer.stats().commits == 0) std::this_thread::yield();
  EXPECT_EQ(writer.stats().rows_written, 32);
}

TEST_F(LogWriter, PushesOfManyThreadsAllArrive) {
  {
    Writer writer(path(), session(), options());
    const auto referee = referee_table(writer);
    std::vector<std::jthread> threads;
    for (std::int64_t thread = 0; thread < 4; ++thread) {
      threads.emplace_back([&, thread] {
        for (std::int64_t i = 0; i < 2000; ++i) {
          writer.push(referee, referee_row(4 * i + thread));
          writer.add_loss("vision_frames", log::LossKind::kLost);
        }
      });
    }
    threads.clear();
    writer.flush();
    EXPECT_EQ(writer.stats().rows_written, 8000);
    EXPECT_GT(writer.stats().rows_per_s, 0.0);
  }
  EXPECT_EQ(rows_of(Reader(path()), "referee"), 8000);
  EXPECT_EQ(loss_of(Reader(path()), "vision_frames").lost, 8000);
}

TEST_F(LogWriter, LossesOfTheBusAreKeptByStream) {
  {
    Writer writer(path(), session(), options());
    writer.add_loss("odometry", log::LossKind::kLost, 2);
    writer.add_loss("odometry", log::LossKind::kGaps, 3);
    writer.add_loss("odometry", log::LossKind::kOutOfOrder, 4);
    writer.add_loss("referee", log::LossKind::kOutOfOrder);
  }
  const Reader reader(path());
  const auto loss = loss_of(reader, "odometry");
  EXPECT_EQ(loss.lost, 2);
  EXPECT_EQ(loss.gaps, 3);
  EXPECT_EQ(loss.out_of_order, 4);
  EXPECT_EQ(loss.missing(), 3) << "what the bus lost shows as a gap too";
  EXPECT_EQ(loss_of(reader, "referee").missing(), 0) << "a late sample is not a lost one";
}

TEST_F(LogWriter, ARecordedMatchIsNeverOverwritten) {
  { Writer writer(path(), session(), options()); }
  const auto size = std::filesystem::file_size(path());
  try {
    Writer again(path(), session(), options());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("match.db exists already"));
  }
  EXPECT_EQ(std::filesystem::file_size(path()), size);
  EXPECT_EQ(Reader(path()).sessions().size(), 1u);
}

TEST_F(LogWriter, OfTwoThatBeginAtOnceOneHasTheFileAndKeepsIt) {
  for (int round = 0; round < 30; ++round) {
    const auto log = path(std::to_string(round) + ".db");
    std::latch both{2};
    std::atomic<int> recorded = 0;
    const auto record = [&] {
      both.arrive_and_wait();
      try {
        Writer writer(log, session(), options());
        EXPECT_TRUE(writer.push(drive_table(writer), drive_row(1, 0.5)));
        writer.finalise();
        ++recorded;
      } catch (const log::FileTaken&) {
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    };
    std::thread other(record);
    record();
    other.join();
    EXPECT_EQ(recorded, 1) << round;
    EXPECT_THAT(Reader(log).sessions(), SizeIs(1)) << round;
  }
}

TEST_F(LogWriter, AnotherThatHoldsTheLockIsNoFailureAndTheRowsComeIntoTheFile) {
  const auto open = [&] {
    return SQLite::Database{path("held.db").string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE};
  };
  SQLite::Database ours = open();
  ours.exec(
      "PRAGMA journal_mode = WAL; CREATE TABLE rows (x); CREATE INDEX by_x ON rows (x); INSERT INTO rows VALUES (1)");
  EXPECT_EQ(ours.execAndGet("SELECT count(*) FROM rows WHERE x = 1").getInt(), 1);
  SQLite::Database other = open();
  other.exec("BEGIN IMMEDIATE");
  EXPECT_FALSE(log::fold(ours));
  std::filesystem::copy_file(path("held.db"), path("copy.db"));
  EXPECT_EQ(SQLite::Database{path("copy.db").string()}.execAndGet("SELECT count(*) FROM rows").getInt(), 1);
  other.exec("ROLLBACK");
  { const SQLite::Database closed{std::move(other)}; }
  EXPECT_TRUE(log::fold(ours));
}

TEST_F(LogWriter, ALogThatIsDeletedOrRenamedMeanwhileIsWrittenAgain) {
  for (const bool deleted : {true, false}) {
    const auto log = path(deleted ? "deleted.db" : "renamed.db");
    Writer writer(log, session(), options());
    const auto drive = drive_table(writer);
    writer.push(drive, drive_row(1, 0.5));
    writer.flush();
    if (deleted) {
      std::filesystem::remove(log);
    } else {
      std::filesystem::rename(log, path("old.db"));
    }
    writer.push(drive, drive_row(2, 0.5));
    writer.flush();
    ASSERT_THAT(warnings_, SizeIs(1));
    EXPECT_THAT(warnings_[0], HasSubstr("was deleted or renamed"));
    writer.finalise();
    EXPECT_EQ(drives_in(log), 2);
    warnings_.clear();
  }
}

TEST_F(LogWriter, WhereAnotherFileIsThereNowItIsWrittenBesideIt) {
  Writer writer(path(), session(), options());
  writer.push(drive_table(writer), drive_row(1, 0.5));
  writer.flush();
  std::filesystem::rename(path(), path("old.db"));
  std::ofstream(path()) << "mine";
  writer.finalise();
  EXPECT_EQ(std::filesystem::file_size(path()), 4u);
  EXPECT_EQ(drives_in(path("match.db.2")), 1);
}

TEST_F(LogWriter, ALogBesideALeftOverWriteAheadLogIsRefused) {
  std::ofstream(path("match.db-wal")) << "rows of another match";
  EXPECT_THROW(Writer(path(), session(), options()), std::runtime_error);
  EXPECT_EQ(std::filesystem::file_size(path("match.db-wal")), 21u);
}

TEST_F(LogWriter, AnEmptyFileBecomesALog) {
  std::ofstream(path()).close();
  { Writer writer(path(), session(), options()); }
  EXPECT_EQ(Reader(path()).sessions().size(), 1u);
}

TEST_F(LogWriter, ALogThatCannotBeMadeIsNamedAndLeavesNoFile) {
  EXPECT_THROW(Writer(directory_ / "missing" / "match.db", session(), options()), std::runtime_error);
  auto wrong = session();
  wrong.policies = {{1, "no policy's name"}};
  EXPECT_THROW(Writer(path(), wrong, options()), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(directory_));
}

TEST_F(LogWriter, TablesAndColumnsThatDoNotExistAreNamed) {
  Writer writer(path(), session(), options());
  const auto message_of = [&](const std::string& table, std::vector<std::string> columns) -> std::string {
    try {
      writer.table(table, std::move(columns));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message_of("wheels", {"seq"}), HasSubstr("'wheels'"));
  EXPECT_THAT(message_of("kicks", {"seq"}), HasSubstr("'kicks'")) << "a view takes no rows";
  EXPECT_THAT(message_of("referee", {"robot_id", "whistle"}), HasSubstr("'whistle'"));
  EXPECT_THAT(message_of("referee", {"robot_id", "seq", "t_ns", "half", "playing"}), HasSubstr("'possession_id'"));
  EXPECT_THAT(message_of("referee", {"session_id"}), HasSubstr("'session_id'"));
}

}  // namespace
}  // namespace trivela::evaluator
