#include "log/merge/clock_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trivela::log {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSecond = 1'000 * kMs;

ClockedSession session(std::int64_t id, int robot_id, std::int64_t realtime_offset_ns, std::int64_t started_s = 0,
                       std::int64_t ended_s = 100) {
  return {id, "uuid " + std::to_string(id), robot_id, started_s * kSecond, ended_s * kSecond, realtime_offset_ns};
}

const AlignedSession& of(const Alignment& alignment, std::int64_t session_id) {
  for (const AlignedSession& aligned : alignment.sessions)
    if (aligned.session_id == session_id) return aligned;
  throw std::out_of_range("it was not aligned");
}

bool has(const Alignment& alignment, std::int64_t session_id) {
  for (const AlignedSession& aligned : alignment.sessions)
    if (aligned.session_id == session_id) return true;
  return false;
}

TEST(ClockAlignment, WithoutMeasurementsNothingIsAligned) {
  const Alignment alignment = align_clocks({session(1, 1, 0), session(2, 2, 0)}, {}, {});
  EXPECT_FALSE(alignment.reference_robot);
  EXPECT_TRUE(alignment.sessions.empty());
}

TEST(ClockAlignment, TakesTheReferencesUtcForWhoMeasuredItAndForWhomItMeasured) {
  const std::vector<ClockedSession> sessions{session(1, 1, 1000), session(2, 2, 7777), session(3, 3, 8888)};
  const Alignment alignment =
      align_clocks(sessions, {{2, 2, 1, 50 * kSecond, -50 * kMs, kMs}, {1, 1, 3, 50 * kSecond, 20 * kMs, kMs}}, 1);
  EXPECT_EQ(alignment.reference_uuid, "uuid 1");
  EXPECT_EQ(utc_offset_at(of(alignment, 1).segments, 0), 1000);
  EXPECT_EQ(utc_offset_at(of(alignment, 2).segments, 60 * kSecond), 1000 - 50 * kMs);
  EXPECT_EQ(utc_offset_at(of(alignment, 3).segments, 60 * kSecond), 1000 - 20 * kMs);
}

TEST(ClockAlignment, GoesOverOthersAndAddsTheirErrors) {
  const Alignment alignment =
      align_clocks({session(1, 1, 0), session(2, 2, 0), session(3, 3, 0)},
                   {{2, 2, 1, 0, 10 * kMs, kMs}, {3, 3, 2, 100 * kSecond, 5 * kMs, 2 * kMs}}, 1);
  EXPECT_EQ(utc_offset_at(of(alignment, 3).segments, 100 * kSecond), 15 * kMs);
  EXPECT_GE(of(alignment, 3).error_ns, 3 * kMs);
  EXPECT_LE(of(alignment, 3).error_ns, 3 * kMs + 2 * 100 * kSecond / 20'000 + 10);
}

TEST(ClockAlignment, FollowsAClockThatDrifts) {
  // Robot 2's clock runs 40 ppm fast; measured every 20 s within 1 ms.
  std::vector<ClockOffset> offsets;
  for (std::int64_t t_s = 0; t_s <= 1000; t_s += 20) {
    const std::int64_t noise_ns = t_s % 40 == 0 ? kMs / 2 : -kMs / 2;
    offsets.push_back({2, 2, 1, t_s * kSecond, -(t_s * kSecond * 4 / 100'000) + noise_ns, kMs});
  }
  const Alignment alignment = align_clocks({session(1, 1, 0, 0, 1000), session(2, 2, 0, 0, 1000)}, offsets, {});
  for (std::int64_t t_s = 0; t_s <= 1000; t_s += 7) {
    const std::int64_t truth_ns = -(t_s * kSecond * 4 / 100'000);
    const std::int64_t found_ns = utc_offset_at(of(alignment, 2).segments, t_s * kSecond) -
                                  utc_offset_at(of(alignment, 1).segments, t_s * kSecond);
    EXPECT_LE(std::abs(found_ns - truth_ns), kMs) << t_s;
  }
}

TEST(ClockAlignment, OfTenSecondsTheSmallestErrorCounts) {
  std::vector<ClockOffset> offsets;
  for (std::int64_t i = 0; i < 10; ++i) offsets.push_back({2, 2, 1, i * kSecond, i == 4 ? 0 : 18 * kMs, 20 * kMs});
  offsets[4].error_ns = kMs;
  const Alignment alignment = align_clocks({session(1, 1, 0, 0, 10), session(2, 2, 0, 0, 10)}, offsets, 1);
  EXPECT_EQ(utc_offset_at(of(alignment, 2).segments, 8 * kSecond), 0);
  EXPECT_LT(of(alignment, 2).error_ns, 2 * kMs);
}

TEST(ClockAlignment, ARobotsSessionsOfOneStartOfItsMachineAreByOneClock) {
  const std::vector<ClockedSession> sessions{session(1, 1, 0), session(2, 2, 500), session(3, 2, 600, 110, 200),
                                             session(4, 2, 300 * kSecond, 5, 90)};
  const Alignment alignment = align_clocks(sessions, {{2, 2, 1, 50 * kSecond, 7, kMs}}, 1);
  EXPECT_EQ(utc_offset_at(of(alignment, 3).segments, 150 * kSecond), 7);
  EXPECT_GT(of(alignment, 3).error_ns, of(alignment, 2).error_ns) << "nobody measured it there";
  EXPECT_FALSE(has(alignment, 4)) << "its clock began again";
}

TEST(ClockAlignment, AMeasurementOfAMachineStartedAnewIsOfTheSessionThatRanThen) {
  // Robot 2 ran for 100 s, was started again and has a clock that is 200 s behind.
  const std::vector<ClockedSession> sessions{session(1, 1, 0, 0, 400), session(2, 2, 0, 0, 100),
                                             session(3, 2, 200 * kSecond, 0, 100)};
  const Alignment alignment =
      align_clocks(sessions, {{1, 1, 2, 50 * kSecond, 3, 1}, {1, 1, 2, 250 * kSecond, -200 * kSecond + 4, 1}}, 1);
  EXPECT_EQ(utc_offset_at(of(alignment, 2).segments, 50 * kSecond), -3);
  EXPECT_EQ(utc_offset_at(of(alignment, 3).segments, 50 * kSecond), 200 * kSecond - 4);
}

TEST(ClockAlignment, TheReferenceIsWhoJoinsMost) {
  const std::vector<ClockedSession> sessions{session(1, 1, 0), session(2, 2, 0), session(3, 3, 0), session(4, 4, 0)};
  const Alignment alignment = align_clocks(sessions, {{3, 3, 2, 0, 1, 1}, {4, 4, 2, 0, 1, 1}}, {});
  EXPECT_EQ(alignment.reference_robot, 2);
  EXPECT_FALSE(has(alignment, 1));
}

}  // namespace
}  // namespace trivela::log
