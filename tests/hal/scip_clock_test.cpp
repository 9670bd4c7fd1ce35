#include <gtest/gtest.h>

#include <cmath>

#include "hal/scip/scan_intake.hpp"

namespace trivela::hal::scip {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kScan = 19 * kMs;
constexpr std::int64_t kHost = 123'456'789'012;  // when the scanner's clock stands at 0

TEST(ScanClock, AReplyThatComesAtOnceGivesTheInstantOfBeam0) {
  ScanClock clock{kScan};
  for (std::int64_t ms = 0; ms < 1000; ms += 25) {
    const auto instant = clock.add(static_cast<std::uint32_t>(ms), kHost + ms * kMs + kScan);
    EXPECT_EQ(instant.t_ns, kHost + ms * kMs);
    EXPECT_EQ(instant.gap_ms.has_value(), ms > 0);
    if (ms > 0) {
      EXPECT_EQ(instant.gap_ms, 25);
    }
  }
}

TEST(ScanClock, LateRepliesDoNotMoveTheInstant) {
  ScanClock clock{kScan};
  clock.add(0, kHost + kScan);
  for (std::int64_t i = 1; i < 400; ++i) {
    const std::int64_t late = i % 10 == 0 ? 0 : (i * 37 % 300) * kMs;
    const auto instant = clock.add(static_cast<std::uint32_t>(25 * i), kHost + 25 * i * kMs + kScan + late);
    EXPECT_NEAR(static_cast<double>(instant.t_ns - kHost - 25 * i * kMs), 0.0, 0.1e6);
  }
}

TEST(ScanClock, ALateFirstReplyIsForgottenAtTheFirstPunctualOne) {
  ScanClock clock{kScan};
  EXPECT_EQ(clock.add(0, kHost + kScan + 300 * kMs).t_ns, kHost + 300 * kMs);
  EXPECT_EQ(clock.add(25, kHost + 25 * kMs + kScan).t_ns, kHost + 25 * kMs);
}

TEST(ScanClock, GoesOnWhenTheStampStartsOver) {
  ScanClock clock{kScan};
  constexpr std::int64_t kTurn = std::int64_t{1} << 24U;
  const std::int64_t start = kTurn - 1000;
  for (std::int64_t i = 0; i < 200; ++i) {
    const std::int64_t ms = start + 25 * i;
    const auto instant = clock.add(static_cast<std::uint32_t>(ms % kTurn), kHost + ms * kMs + kScan);
    EXPECT_EQ(instant.t_ns, kHost + ms * kMs);
    if (i > 0) {
      EXPECT_EQ(instant.gap_ms, 25);
    }
  }
}

TEST(ScanClock, FollowsClocksThatDifferBy100PartsInAMillion) {
  for (const double rate : {1.0 - 1e-4, 1.0 + 1e-4}) {
    ScanClock clock{kScan};
    for (std::int64_t i = 0; i < 200'000; ++i) {  // 83 minutes
      const std::int64_t beam_0 = kHost + 25 * i * kMs;
      const auto stamp = static_cast<std::uint32_t>(std::floor(static_cast<double>(25 * i) * rate)) & 0xffffff;
      const std::int64_t late = i % 7 * kMs;
      const auto instant = clock.add(stamp, beam_0 + kScan + late);
      if (i > 1000) {
        ASSERT_NEAR(static_cast<double>(instant.t_ns - beam_0), 0.0, 1.2e6) << i;
      }
    }
  }
}

TEST(ScanClock, GapsShowLostScans) {
  ScanClock clock{kScan};
  clock.add(1000, kHost);
  EXPECT_EQ(clock.add(1100, kHost + 100 * kMs).gap_ms, 100);
}

TEST(ScanClock, AStampThatRunsBackwardsStartsAnew) {
  ScanClock clock{kScan};
  clock.add(100'000, kHost + kScan);
  const auto instant = clock.add(0, kHost + 25 * kMs + kScan);
  EXPECT_EQ(instant.t_ns, kHost + 25 * kMs);
  EXPECT_FALSE(instant.gap_ms);
}

TEST(ScanClock, OneStampFarAheadSpoilsNoScanAfterIt) {
  ScanClock clock{kScan};
  clock.add(0, kHost + kScan);
  EXPECT_FALSE(clock.add(2'000'000, kHost + 25 * kMs + kScan).gap_ms);
  for (std::int64_t i = 2; i < 5; ++i) {
    const auto instant = clock.add(static_cast<std::uint32_t>(25 * i), kHost + 25 * i * kMs + kScan);
    EXPECT_EQ(instant.t_ns, kHost + 25 * i * kMs);
  }
}

}  // namespace
}  // namespace trivela::hal::scip
