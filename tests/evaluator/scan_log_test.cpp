#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <fstream>

#include "tests/evaluator/scan_fixture.hpp"

namespace trivela::evaluator {
namespace {

using log::ScanReader;
using log::ScanWriter;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;

using ScanLog = ScanTest;

TEST_F(ScanLog, GivesBackWhatWasRecorded) {
  {
    ScanWriter writer(path("scans.db"), scan_session(), options());
    writer.set_point({.t_ns = 1500, .power = 22.5, .kick_id = 0});
    for (std::int64_t n = 0; n < 100; ++n) EXPECT_TRUE(writer.push(scan(n)));
    writer.set_point({.t_ns = 9000, .power = 30.0, .kick_id = 77});
    writer.verdict({.launch_t_ns = 8000, .accepted = false, .why = "hit the post"});
    writer.verdict({.launch_t_ns = 8000, .accepted = true, .why = ""});
    writer.finalise();
  }
  const ScanReader reader(path("scans.db"));
  ASSERT_EQ(reader.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(reader.t_ns(i), scan(static_cast<std::int64_t>(i)).t_ns);
    EXPECT_EQ(reader.scan(i).t_ns, reader.t_ns(i));
    EXPECT_EQ(reader.scan(i).range_mm, scan(static_cast<std::int64_t>(i)).range_mm);
  }
  const auto set_points = reader.set_points();
  ASSERT_EQ(set_points.size(), 2u);
  EXPECT_EQ(set_points[0].t_ns, 1500);
  EXPECT_EQ(set_points[0].power, 22.5);
  EXPECT_EQ(set_points[1].kick_id, 77);
  const auto verdicts = reader.verdicts();
  ASSERT_EQ(verdicts.size(), 2u);
  EXPECT_EQ(verdicts[0].launch_t_ns, 8000);
  EXPECT_FALSE(verdicts[0].accepted);
  EXPECT_EQ(verdicts[0].why, "hit the post");
  EXPECT_TRUE(verdicts[1].accepted);
  EXPECT_THAT(reader.warnings(), IsEmpty());
}

TEST_F(ScanLog, GivesBackTheSession) {
  write_record(1);
  const ScanReader reader(path("scans.db"));
  const log::ScanSession& read = reader.session();
  const log::ScanSession written = scan_session();
  EXPECT_EQ(read.identity.vendor, "vendor");
  EXPECT_EQ(read.identity.product, "product");
  EXPECT_EQ(read.identity.serial, "H0001");
  EXPECT_EQ(read.identity.firmware, "1.2");
  EXPECT_EQ(read.identity.protocol, "SCIP 2.0");
  EXPECT_EQ(read.geometry.beams, written.geometry.beams);
  EXPECT_EQ(read.geometry.first_angle_rad, written.geometry.first_angle_rad);
  EXPECT_EQ(read.geometry.step_rad, written.geometry.step_rad);
  EXPECT_EQ(read.geometry.beam_period_s, written.geometry.beam_period_s);
  EXPECT_EQ(read.geometry.scan_period_s, written.geometry.scan_period_s);
  EXPECT_EQ(read.geometry.min_range_m, written.geometry.min_range_m);
  EXPECT_EQ(read.geometry.max_range_m, written.geometry.max_range_m);
  EXPECT_EQ(read.mount.x_m, written.mount.x_m);
  EXPECT_EQ(read.mount.z_m, written.mount.z_m);
  EXPECT_EQ(read.mount.front_elevation_rad, written.mount.front_elevation_rad);
  EXPECT_TRUE(read.mount.mirrored);
  EXPECT_TRUE(read.simulated);
  EXPECT_EQ(read.started_t_ns, 1000);
  EXPECT_EQ(read.realtime_offset_ns, -5);
  EXPECT_EQ(read.source, written.source);
  EXPECT_EQ(read.software_version, "test");
}

TEST_F(ScanLog, IsNeverOverwritten) {
  write_record(3);
  EXPECT_THROW(ScanWriter(path("scans.db"), scan_session(), options()), std::runtime_error);
  try {
    const ScanWriter writer(path("scans.db"), scan_session(), options());
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("scans.db exists already; a recorded scan is never overwritten"));
  }
  EXPECT_EQ(ScanReader(path("scans.db")).size(), 3u);
}

TEST_F(ScanLog, AFolderThatIsNotThereIsNamed) {
  try {
    const ScanWriter writer(path("no/scans.db"), scan_session(), options());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot create the scan record " + path("no/scans.db").string() +
                                        ": No such file or directory"));
  }
}

TEST_F(ScanLog, AScanOfAnotherNumberOfBeamsIsRefused) {
  ScanWriter writer(path("scans.db"), scan_session(), options());
  EXPECT_THROW(writer.push({.t_ns = 0, .range_mm = {1, 2, 3}}), std::invalid_argument);
}

TEST_F(ScanLog, AMissingFileIsNamed) {
  EXPECT_THAT(message_of_opening(), HasSubstr("there is no scan record " + path("scans.db").string()));
  EXPECT_FALSE(log::is_scan_log(path("scans.db")));
}

TEST_F(ScanLog, AMatchLogIsSaidToBeOneAndTheOtherWayRound) {
  { const log::Writer writer(path(), session(), options()); }
  write_record(1);
  EXPECT_THAT(message_of_opening("match.db"), HasSubstr("match.db is not a scan record but a match log"));
  EXPECT_FALSE(log::is_scan_log(path("match.db")));
  EXPECT_TRUE(log::is_scan_log(path("scans.db")));
  try {
    const log::Reader reader(path("scans.db"));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("scans.db is not a match log but a scan record"));
  }
}

TEST_F(ScanLog, OtherFilesAreNotScanRecords) {
  std::ofstream(path("garbage.db")) << std::string(8192, 'x');
  SQLite::Database(path("other.db").string(), SQLite::OPEN_CREATE | SQLite::OPEN_READWRITE).exec("CREATE TABLE t (a)");
  for (const char* const name : {"garbage.db", "other.db"}) {
    EXPECT_THAT(message_of_opening(name), HasSubstr(std::string(name) + " is not a scan record")) << name;
    EXPECT_FALSE(log::is_scan_log(path(name))) << name;
  }
  std::ofstream(path("empty.db")).close();
  EXPECT_THAT(message_of_opening("empty.db"), HasSubstr("empty.db is empty, no scan record"));
  EXPECT_FALSE(log::is_scan_log(path("empty.db")));
}

TEST_F(ScanLog, ATruncatedRecordIsDamagedWhereverItEnds) {
  write_record(3000);
  const auto size = std::filesystem::file_size(path("scans.db"));
  for (const double part : {0.95, 0.7, 0.5, 0.2, 0.05}) {
    std::filesystem::copy_file(path("scans.db"), path("short.db"), std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(path("short.db"), static_cast<std::uintmax_t>(part * static_cast<double>(size)));
    EXPECT_THAT(message_of_opening("short.db"), AnyOf(HasSubstr("is damaged"), HasSubstr("is not a scan record")))
        << part;
  }
}

TEST_F(ScanLog, AScanWhoseBytesMakeNoSenseIsNamed) {
  write_record(3);
  SQLite::Database(path("scans.db").string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE scans SET ranges = x'0102' WHERE seq = 1");
  const ScanReader reader(path("scans.db"));
  EXPECT_EQ(reader.scan(0).range_mm, scan(0).range_mm);
  try {
    reader.scan(1);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("scans.db is damaged: scan 1 does not hold the ranges of 7 beams"));
  }
}

TEST_F(ScanLog, ARecordThatGrowsIsReadWhileItDoes) {
  ScanWriter writer(path("scans.db"), scan_session(), options());
  writer.push(scan(0));
  writer.flush();
  ScanReader reader(path("scans.db"));
  EXPECT_EQ(reader.size(), 1u);
  ASSERT_EQ(reader.warnings().size(), 1u);
  EXPECT_THAT(reader.warnings()[0], HasSubstr("was not closed"));
  writer.push(scan(1));
  writer.flush();
  EXPECT_EQ(reader.size(), 1u);
  EXPECT_EQ(reader.refresh(), 2u);
  EXPECT_EQ(reader.scan(1).range_mm, scan(1).range_mm);
}

TEST_F(ScanLog, ScansThatFindTheQueueFullAreCounted) {
  {
    ScanWriter writer(path("scans.db"), scan_session(), options(4, 3600.0));
    int lost = 0;
    for (std::int64_t n = 0; n < 5000; ++n) lost += writer.push(scan(n)) ? 0 : 1;
    ASSERT_GT(lost, 0);
    writer.finalise();
    const ScanReader reader(path("scans.db"));
    EXPECT_EQ(reader.size(), 5000u - static_cast<std::size_t>(lost));
    ASSERT_EQ(reader.warnings().size(), 1u);
    EXPECT_EQ(reader.warnings()[0], "scans: " + std::to_string(lost) + " rows are missing");
  }
}

}  // namespace
}  // namespace trivela::evaluator
