#include "hal/scip/scan_intake.hpp"

#include <gtest/gtest.h>

#include "hal/scip/reply.hpp"
#include "tests/hal/scip_text.hpp"

namespace trivela::hal::scip {
namespace {

constexpr std::int64_t kMs = 1'000'000;
const Parameters kThreeBeams{"m", 20, 5600, 1024, 10, 12, 10, 600};  // 100 ms a scan

Reply md_reply(std::string_view status, std::uint32_t stamp_ms, std::string_view data = "00B1Dh7D`",
               std::string_view echo = "MD0010001201000") {
  ReplyParser parser;
  return parser.feed(scan_reply(echo, status, stamp_ms, data)).at(0);
}

class ScipIntake : public testing::Test {
 protected:
  bool take(const Reply& reply, std::int64_t arrival_ms = 0) {
    return intake_.take(reply, arrival_ms * kMs, counters_).has_value();
  }

  ScanIntake intake_{Asking::kContinuous, kThreeBeams};
  LinkCounters counters_;
};

TEST_F(ScipIntake, AScanHasItsRangesAndTheInstantOfBeam0) {
  const auto scan = intake_.take(md_reply("99", 5000), 7000 * kMs, counters_);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->range_mm, (std::vector<std::uint32_t>{18, 5432, 30000}));
  EXPECT_NEAR(static_cast<double>(scan->t_ns), 7000e6 - 3 * 0.1 / 1024 * 1e9, 1.0);
  EXPECT_EQ(counters_.scans, 1U);
}

TEST_F(ScipIntake, LostScansAreTheWholePeriodsThatAreMissing) {
  std::int64_t ms = 0;
  std::uint64_t lost = 0;
  EXPECT_TRUE(take(md_reply("99", 0), 0));
  for (const int gap_ms : {100, 99, 101, 200, 149, 151, 1000}) {
    ms += gap_ms;
    EXPECT_TRUE(take(md_reply("99", static_cast<std::uint32_t>(ms)), ms));
    lost += static_cast<std::uint64_t>((gap_ms + 50) / 100 - 1);
    EXPECT_EQ(counters_.lost_scans, lost) << gap_ms;
  }
}

TEST_F(ScipIntake, ScansThatAreAskedForOneByOneAreNotMissed) {
  ScanIntake one_by_one{Asking::kOneByOne, kThreeBeams};
  EXPECT_EQ(one_by_one.request(), "GD0010001201");
  for (std::uint32_t ms = 0; ms < 5000; ms += 1000) {
    EXPECT_TRUE(one_by_one.take(md_reply("00", ms, "00B1Dh7D`", "GD0010001201"), ms * kMs, counters_));
  }
  EXPECT_EQ(counters_.lost_scans, 0U);
}

TEST_F(ScipIntake, TheAcceptanceOfTheRequestIsNothing) {
  ReplyParser parser;
  EXPECT_FALSE(take(parser.feed(plain_reply(intake_.request(), "00")).at(0)));
  EXPECT_EQ(counters_.torn_lines + counters_.error_replies, 0U);
}

TEST_F(ScipIntake, AnotherNumberOfBeamsAndAnotherEchoAreTorn) {
  EXPECT_FALSE(take(md_reply("99", 0, "00B1Dh")));
  EXPECT_FALSE(take(md_reply("99", 0, "00B1Dh7D`000")));
  EXPECT_FALSE(take(md_reply("99", 0, "00B1Dh7D ")));
  EXPECT_FALSE(take(md_reply("99", 0, "00B1Dh7D`", "MD0010001301000")));
  EXPECT_FALSE(take(md_reply("99", 0, "00B1Dh7D`", "GD0010001201")));
  EXPECT_EQ(counters_.torn_lines, 5U);
  EXPECT_EQ(counters_.scans, 0U);
}

TEST_F(ScipIntake, AnErrorIsComplainedOfUntilTheNextScan) {
  ReplyParser parser;
  EXPECT_FALSE(take(parser.feed(plain_reply(intake_.request(), "55")).at(0)));
  EXPECT_EQ(counters_.error_replies, 1U);
  EXPECT_EQ(intake_.complaint(), "the scanner has a fault in its hardware");
  EXPECT_TRUE(take(md_reply("99", 0)));
  EXPECT_EQ(intake_.complaint(), "");
}

}  // namespace
}  // namespace trivela::hal::scip
