// What is kept of a calibration between two starts.
#include "calibration/field_calibration.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "config/text/error.hpp"
#include "log/write/writer.hpp"
#include "tests/support/folder.hpp"

namespace trivela::calibration {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

void touch(const std::filesystem::path& file) { std::ofstream{file} << "a record"; }

TEST(CalibrationRecord, ASecondStartKnowsWhatWasMeasuredAndPlayed) {
  const tests::Folder folder;
  {
    CalibrationRecord kept{folder.path(), "--kicks 16"};
    EXPECT_FALSE(kept.measured("laser_x_m"));
    kept.measure("laser_x_m", 3.987);
    kept.finish("1_standing");
  }
  const CalibrationRecord kept{folder.path(), "--kicks 16"};
  EXPECT_EQ(kept.measured("laser_x_m"), 3.987);
  EXPECT_FALSE(kept.measured("laser_z_m"));
  EXPECT_TRUE(kept.finished("1_standing"));
  EXPECT_FALSE(kept.finished("3_lateral"));
}

TEST(CalibrationRecord, OtherArgumentsAreAnotherCalibration) {
  const tests::Folder folder;
  const CalibrationRecord begun{folder.path(), "--kicks 16"};
  EXPECT_THAT([&] { CalibrationRecord(folder.path(), "--kicks 8"); },
              ThrowsMessage<config::BadArgument>(HasSubstr("was begun with '--kicks 16', not with '--kicks 8'")));
}

TEST(CalibrationRecord, ABrokenBookIsNamed) {
  const tests::Folder folder;
  touch(folder / "calibration.json");
  EXPECT_THAT([&] { CalibrationRecord(folder.path(), "--kicks 16"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("calibration.json is cut short")));
}

TEST(CalibrationRecord, ABrokenBookIsMendedWithWhatItsMessageSays) {
  const tests::Folder folder;
  const auto session = [](char last) {
    log::Session begun;
    begun.uuid = std::string("00000000-0000-4000-8000-00000000000") + last;
    return begun;
  };
  log::Writer{folder / "1_standing.db", session('1'), {}}.finalise();
  const log::Writer running{folder / "2_straight.db", session('2'), {}};
  touch(folder / "3_lateral.db");
  touch(folder / "calibration.json");
  std::string said;
  try {
    CalibrationRecord(folder.path(), "--kicks 16");
  } catch (const std::runtime_error& error) {
    said = error.what();
  }
  ASSERT_NE(said.find('{'), std::string::npos) << said;
  std::ofstream{folder / "calibration.json"} << said.substr(said.find('{'));
  const CalibrationRecord kept{folder.path(), "--kicks 16"};
  EXPECT_TRUE(kept.finished("1_standing"));
  EXPECT_FALSE(kept.finished("2_straight") || kept.finished("3_lateral"));
}

TEST(CalibrationRecord, RecordsOfAnUnfinishedDriveAreKeptBesideTheNextOnes) {
  const tests::Folder folder;
  for (int start = 1; start <= 2; ++start) {
    for (const char* record : {"1_standing.db", "1_standing.scans.db"}) touch(folder / record);
    touch(folder / "1_standing_2.db");  // of another drive
    EXPECT_EQ(set_aside(folder.path(), "1_standing"), 2u);
  }
  EXPECT_EQ(set_aside(folder.path(), "1_standing"), 0u);
  EXPECT_THAT(folder.files(""), testing::UnorderedElementsAre(
                                    "1_standing.partial-1.db", "1_standing.partial-1.scans.db",
                                    "1_standing.partial-2.db", "1_standing.partial-2.scans.db", "1_standing_2.db"));
}

}  // namespace
}  // namespace trivela::calibration
