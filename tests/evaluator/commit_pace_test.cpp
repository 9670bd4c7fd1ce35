// How long the log's rows wait for company, on a clock that the tests turn.
#include "log/write/row_queue.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <deque>

namespace trivela::log {
namespace {

using namespace std::chrono_literals;
using Duration = CommitPace::Clock::duration;
using Time = CommitPace::Clock::time_point;
using testing::HasSubstr;

constexpr double kSpan_s = 0.1;

/// Rows that come every millisecond, one thread that commits them, each commit as long as `commit_of` says; returns the
/// age of the oldest row at the end of its commit, once the pace knows the disk.
template <class Commit>
Duration oldest_row(Commit commit_of, int groups = 500) {
  CommitPace pace{kSpan_s};
  Time now{};
  Time first{};  // row of the group that is collected
  Duration oldest{0};
  for (int group = 0; group < groups; ++group) {
    const Time begin = std::max(now, first + pace.wait());
    const Duration commit = commit_of(group);
    now = begin + commit;
    pace.committed(commit, now - first, now);
    if (group >= 100) oldest = std::max(oldest, now - first);
    first = begin + 1ms;  // comes as the commit begins
  }
  return oldest;
}

TEST(CommitPace, ARowIsSafeWithinTheSpanWhateverTheDiskTakesUpToHalfOfIt) {
  for (const Duration commit : {0ms, 1ms, 5ms, 20ms, 28ms, 40ms, 49ms, 50ms}) {
    EXPECT_LE(oldest_row([&](int) { return commit; }), 100ms) << commit / 1ms << " ms";
  }
}

TEST(CommitPace, TheRareCommitThatFoldsTheLogIsAllowedFor) {
  EXPECT_LE(oldest_row([](int group) { return group % 50 == 0 ? 45ms : 2ms; }), 100ms);
}

TEST(CommitPace, ASlowerDiskIsKeptBusyAndARowWaitsForTwoCommits) {
  EXPECT_LE(oldest_row([](int) { return 300ms; }), 600ms);
}

TEST(CommitPace, AFastDiskIsAskedAboutFifteenTimesASecond) {
  CommitPace pace{kSpan_s};
  pace.committed(1ms, 65ms, Time{1s});
  EXPECT_EQ(pace.wait(), 65ms);
}

TEST(CommitPace, AHiccupOfAFastDiskIsAllowedForBeforeItIsKnown) {
  EXPECT_LE(oldest_row([](int group) { return group % 200 == 0 ? 35ms : 1ms; }), 100ms);
}

TEST(CommitPace, AnUnknownDiskMayBeASlowOne) { EXPECT_EQ(CommitPace{kSpan_s}.wait(), 40ms); }

TEST(CommitPace, OneSlowCommitIsForgottenAndNeverMakesHaste) {
  CommitPace pace{kSpan_s};
  pace.committed(10s, 10s, Time{});
  EXPECT_EQ(pace.wait(), 40ms);
  for (int i = 0; i < 64; ++i) pace.committed(1ms, 65ms, Time{});
  EXPECT_EQ(pace.wait(), 65ms);
  EXPECT_EQ(pace.oldest(), 10s);
}

TEST(CommitPace, LatenessIsSaidWithItsFigureAndSeldom) {
  CommitPace pace{kSpan_s};
  EXPECT_FALSE(pace.committed(90ms, 100ms, Time{1s}));
  const auto first = pace.committed(120ms, 180ms, Time{2s});
  ASSERT_TRUE(first);
  EXPECT_THAT(*first, HasSubstr("rows waited up to 0.180 s for the disk, 0.1 s are allowed"));
  EXPECT_THAT(*first, HasSubstr("took 0.120 s (1 late)"));
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(pace.committed(150ms, i == 7 ? 900ms : 200ms, Time{2s + 10ms * i}));
  const auto second = pace.committed(120ms, 180ms, Time{13s});
  ASSERT_TRUE(second);
  EXPECT_THAT(*second, HasSubstr("up to 0.900 s"));
  EXPECT_THAT(*second, HasSubstr("(51 late)"));
}

}  // namespace
}  // namespace trivela::log
