// The emulator says what the specification says: requests as text, replies as text.
#include "emulators/scip/emulated_scanner.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "hal/scip/reply.hpp"
#include "tests/hal/scip_text.hpp"

namespace trivela::hal::scip {
namespace {

const std::vector<std::uint32_t> kRanges{1000, 5, 900, 800, 3, 7, 2000, 19, 20, 300000};

class ScipEmulatedScanner : public testing::Test {
 protected:
  std::string status_of(std::string_view request) {
    ReplyParser parser;
    const auto replies = parser.feed(scanner_.answer(request));
    if (replies.size() != 1) return "none";
    EXPECT_EQ(replies.front().echo, request);
    return replies.front().status;
  }
  Reply next() {
    ReplyParser parser;
    const auto replies = parser.feed(scanner_.next_scan(kRanges, 0));
    return replies.empty() ? Reply{} : replies.front();
  }

  EmulatedScanner scanner_{{"v", "p", "f", "SCIP 2.0", "s"}, {"m", 20, 5600, 1024, 44, 53, 48, 600}};
};

TEST_F(ScipEmulatedScanner, SaysTheRecordedScanByteForByte) {
  std::vector<std::uint32_t> ranges{0, 18, 500, 1000, 1234, 5432, 12345, 30000};
  while (ranges.size() < 48) ranges.push_back(1000 + 7 * static_cast<std::uint32_t>(ranges.size() - 8));
  EmulatedScanner scanner{{}, {"m", 20, 5600, 1024, 0, 47, 0, 600}};
  scanner.answer("MD0000004700000");
  EXPECT_EQ(scanner.next_scan(ranges, decode("0N90").value()), tests::recorded_scan());
}

TEST_F(ScipEmulatedScanner, RefusesWithTheStatusOfTheSpecification) {
  EXPECT_EQ(status_of("MDx044005301000"), "01");
  EXPECT_EQ(status_of("MD0044x05301000"), "02");
  EXPECT_EQ(status_of("MD00440053x1000"), "03");
  EXPECT_EQ(status_of("MD0044005401000"), "04");
  EXPECT_EQ(status_of("MD0043005301000"), "04");
  EXPECT_EQ(status_of("MD0050004901000"), "05");
  EXPECT_EQ(status_of("MD0044005301x00"), "06");
  EXPECT_EQ(status_of("MD00440053010x0"), "07");
  EXPECT_EQ(status_of("MD004400530100"), "0C");
  EXPECT_EQ(status_of("GD0044005301"), "10");
  EXPECT_EQ(status_of("XX"), "0E");
  EXPECT_FALSE(scanner_.measuring());
}

TEST_F(ScipEmulatedScanner, TheLaserGoesOnOnceAndOffWithQuitAndReset) {
  EXPECT_EQ(status_of("BM"), "00");
  EXPECT_EQ(status_of("BM"), "02");
  EXPECT_TRUE(scanner_.laser_on());
  EXPECT_EQ(status_of("QT"), "00");
  EXPECT_FALSE(scanner_.laser_on());
  EXPECT_FALSE(scanner_.take_reset());
  EXPECT_EQ(status_of("BM"), "00");
  EXPECT_EQ(status_of("RS"), "00");
  EXPECT_FALSE(scanner_.laser_on());
  EXPECT_TRUE(scanner_.take_reset());
  EXPECT_FALSE(scanner_.take_reset());
}

TEST_F(ScipEmulatedScanner, AnMdOfThreeScansCountsDownAndSwitchesTheLaserOff) {
  EXPECT_EQ(status_of("MD0044005301003;abc"), "00");
  for (const std::string echo : {"MD0044005301002;abc", "MD0044005301001;abc", "MD0044005301000;abc"}) {
    EXPECT_TRUE(scanner_.laser_on());
    EXPECT_EQ(next().echo, echo);
  }
  EXPECT_FALSE(scanner_.measuring());
  EXPECT_FALSE(scanner_.laser_on());
}

TEST_F(ScipEmulatedScanner, AnMdWithoutAnEndLeavesScansOut) {
  EXPECT_EQ(status_of("MD0044005301200"), "00");
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(next().status, "99");
    EXPECT_EQ(next().status, "");
    EXPECT_EQ(next().status, "");
  }
}

TEST_F(ScipEmulatedScanner, AGdIsAnsweredWithTheScan) {
  status_of("BM");
  EXPECT_EQ(status_of("GD0046004801"), "none");
  const Reply reply = next();
  EXPECT_EQ(reply.echo, "GD0046004801");
  EXPECT_EQ(reply.status, "00");
  EXPECT_EQ(ranges_of(reply, 3), (std::vector<std::uint32_t>{900, 800, 3}));
  EXPECT_TRUE(scanner_.laser_on());
}

TEST_F(ScipEmulatedScanner, AClusterIsItsNearestReturnOrAnErrorCode) {
  status_of("MD0044005302000");
  const auto pairs = ranges_of(next(), beams({44, 53, 2}));
  EXPECT_EQ(pairs, (std::vector<std::uint32_t>{1000, 800, 3, 2000, 20}));
  status_of("MD0044005304000");
  // The last cluster has two steps; what 18 bits cannot say is the farthest that they can.
  EXPECT_EQ(ranges_of(next(), beams({44, 53, 4})), (std::vector<std::uint32_t>{800, 2000, 20}));
  status_of("MD0053005301000");
  EXPECT_EQ(ranges_of(next(), 1), (std::vector<std::uint32_t>{262143}));
}

TEST_F(ScipEmulatedScanner, RefusesAGeometryThatScipCannotSay) {
  kicking::lob::ScanGeometry geometry;
  EXPECT_NO_THROW(parameters_for(geometry, 0, ""));
  geometry.beams = 10001;
  EXPECT_THROW(parameters_for(geometry, 0, ""), std::runtime_error);
  geometry.beams = 0;
  EXPECT_THROW(parameters_for(geometry, 0, ""), std::runtime_error);
  EXPECT_THROW(parameters_for({}, -1, ""), std::runtime_error);
}

}  // namespace
}  // namespace trivela::hal::scip
