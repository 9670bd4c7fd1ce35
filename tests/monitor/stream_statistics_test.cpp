#include "monitor/stream_statistics.hpp"

#include <gmock/gmock.h>

namespace trivela::monitor {
namespace {

using testing::DoubleNear;
using testing::Eq;
using testing::Optional;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStart = 1'000'000 * kMs;
constexpr double kPeriod_s = 0.02;

/// A stream of robot 1 with a sample each 20 ms, 0.1 ms under way.
class Stream : public testing::Test {
 protected:
  ReceivedSample at(std::int64_t ms, std::optional<std::uint64_t> seq, std::uint64_t writer = 1) const {
    const std::int64_t now = kStart + ms * kMs;
    return {writer, seq, now - 3 * kMs, now - kMs / 10, now, now};
  }
  void play(std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t seq = from; seq <= to; ++seq) statistics.see(1, at(static_cast<std::int64_t>(20 * seq), seq));
  }
  StreamFigures after(std::int64_t ms) const { return statistics.figures(kStart + ms * kMs); }

  StreamStatistics statistics{kPeriod_s};
};

TEST_F(Stream, HasNothingBeforeTheFirstSample) {
  const StreamFigures figures = after(1000);
  EXPECT_EQ(figures.received, 0);
  EXPECT_EQ(figures.rate_hz, 0.0);
  EXPECT_EQ(figures.missed_deadlines, 0);
  EXPECT_EQ(figures.latency_p50_us, std::nullopt);
  EXPECT_EQ(figures.silent_for_s, std::nullopt);
}

TEST_F(Stream, HasTheRateOfItsCycle) {
  play(1, 500);
  EXPECT_THAT(after(10'000).rate_hz, DoubleNear(50.0, 0.3));
  EXPECT_THAT(after(10'000).rate_now_hz, DoubleNear(50.0, 1.1));
}

TEST_F(Stream, HasTheRateOfItsCycleAlsoWhenItWasHeardForLessThanTheWindow) {
  play(1, 26);
  EXPECT_THAT(after(520).rate_hz, DoubleNear(50.0, 0.1));
  EXPECT_THAT(after(520).rate_now_hz, DoubleNear(50.0, 0.1));
}

TEST_F(Stream, ForgetsTheRateOfAWriterThatFellSilent) {
  play(1, 500);
  EXPECT_EQ(after(11'500).rate_now_hz, 0.0);
  EXPECT_THAT(after(11'500).rate_hz, DoubleNear(35.0, 0.5));
  EXPECT_EQ(after(16'000).rate_hz, 0.0);
  EXPECT_THAT(after(16'000).silent_for_s, Optional(DoubleNear(6.0, 1e-9)));
}

TEST_F(Stream, TellsLatencyFromTheSourceTimestampAndAgeFromTheMessage) {
  play(1, 99);
  ReceivedSample slow = at(2000, 100);
  slow.source_ns -= 5 * kMs;
  statistics.see(1, slow);
  EXPECT_THAT(after(2000).latency_p50_us, Optional(DoubleNear(100.0, 0.01)));
  EXPECT_THAT(after(2000).age_p50_ms, Optional(DoubleNear(3.0, 1e-6)));
  statistics.see(1, slow);
  EXPECT_THAT(after(2000).latency_p99_us, Optional(DoubleNear(5100.0, 0.01)));
}

TEST_F(Stream, HasNoAgeWhereItsInstantsAreOfAnotherClock) {
  ReceivedSample lockstep = at(0, 1);
  lockstep.t_ns = 20 * kMs;
  statistics.see(1, lockstep);
  ReceivedSample ahead = at(20, 2);
  ahead.t_ns = ahead.received_ns + 1;
  statistics.see(1, ahead);
  EXPECT_EQ(after(20).age_p50_ms, std::nullopt);
}

TEST_F(Stream, CountsWhatWasSkippedAndWhatCameLateAfterAll) {
  play(1, 10);
  statistics.see(1, at(300, 14));
  EXPECT_EQ(after(300).lost, 3);
  statistics.see(1, at(310, 12));
  EXPECT_EQ(after(310).lost, 2);
  EXPECT_EQ(after(310).out_of_order, 1);
  EXPECT_EQ(after(310).received, 12);
}

TEST_F(Stream, CountsTwoWritersByTheirOwnNumbers) {
  for (int i = 0; i < 20; ++i) {
    statistics.see(1, at(40 * i, static_cast<std::uint64_t>(1 + i), 1));
    statistics.see(1, at(40 * i + 20, static_cast<std::uint64_t>(900 + i), 2));
  }
  EXPECT_EQ(after(800).lost, 0);
  EXPECT_EQ(after(800).out_of_order, 0);
}

TEST_F(Stream, LosesNothingWhereMessagesHaveNoNumber) {
  for (int i = 0; i < 5; ++i) statistics.see(1, at(20 * i, std::nullopt));
  EXPECT_EQ(after(100).lost, 0);
  EXPECT_EQ(after(100).received, 5);
}

TEST_F(Stream, MissesADeadlineForEveryThreePeriodsOfSilence) {
  play(1, 10);
  EXPECT_EQ(after(259).missed_deadlines, 0);
  EXPECT_EQ(after(260).missed_deadlines, 1);
  EXPECT_EQ(after(320).missed_deadlines, 2);
  statistics.see(1, at(330, 11));
  EXPECT_EQ(after(330).missed_deadlines, 2) << "the silence that is over counts as it did while it lasted";
}

TEST(StreamStatistics, MissesNoDeadlineWhereThereIsNoPeriod) {
  StreamStatistics statistics{0.0};
  statistics.see(1, {1, 1, 0, 0, kStart, kStart});
  statistics.see(1, {1, 2, 0, 0, 2 * kStart, 2 * kStart});
  EXPECT_EQ(statistics.figures(3 * kStart).missed_deadlines, 0);
}

}  // namespace
}  // namespace trivela::monitor
