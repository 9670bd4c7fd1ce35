#include "robot/watch/sequence_watch.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace trivela::robot {
namespace {

TEST(SequenceWatch, FindsNothingInAnUnbrokenStream) {
  SequenceWatch watch;
  for (std::uint64_t seq = 1; seq <= 100; ++seq) {
    const auto finding = watch.see(1, seq, 7);
    EXPECT_EQ(finding.seq, static_cast<std::int64_t>(seq));
    EXPECT_EQ(finding.gap, 0);
    EXPECT_FALSE(finding.out_of_order);
  }
}

TEST(SequenceWatch, CountsWhatWasSkipped) {
  SequenceWatch watch;
  watch.see(1, 1, 7);
  EXPECT_EQ(watch.see(1, 2, 7).gap, 0);
  EXPECT_EQ(watch.see(1, 5, 7).gap, 2);
  EXPECT_EQ(watch.see(1, 6, 7).gap, 0);
}

TEST(SequenceWatch, WhoComesLateHasMissedNothing) {
  SequenceWatch watch;
  const auto finding = watch.see(1, 500, 7);
  EXPECT_EQ(finding.gap, 0);
  EXPECT_FALSE(finding.out_of_order);
  EXPECT_EQ(watch.see(1, 502, 7).gap, 1);
}

TEST(SequenceWatch, SeesWhatComesTwiceOrOutOfOrder) {
  SequenceWatch watch;
  watch.see(1, 1, 7);
  watch.see(1, 4, 7);
  EXPECT_TRUE(watch.see(1, 4, 7).out_of_order);
  const auto late = watch.see(1, 3, 7);
  EXPECT_TRUE(late.out_of_order);
  EXPECT_EQ(late.gap, 0);
  const auto next = watch.see(1, 5, 7);
  EXPECT_FALSE(next.out_of_order);
  EXPECT_EQ(next.gap, 0);
}

TEST(SequenceWatch, KeepsRobotsApart) {
  SequenceWatch watch;
  for (std::uint64_t seq = 1; seq <= 5; ++seq) {
    EXPECT_EQ(watch.see(1, seq, 7).gap, 0);
    EXPECT_EQ(watch.see(2, 10 * seq, 8).gap, seq == 1 ? 0 : 9);
  }
}

TEST(SequenceWatch, AWriterThatStartsAgainGoesOnCountingUp) {
  SequenceWatch watch;
  for (std::uint64_t seq = 1; seq <= 10; ++seq) watch.see(1, seq, 7);
  const auto again = watch.see(1, 1, 8);
  EXPECT_EQ(again.seq, 11);
  EXPECT_EQ(again.gap, 0);
  EXPECT_FALSE(again.out_of_order);
  EXPECT_EQ(watch.see(1, 4, 8).gap, 2) << "the new writer's gaps count";
  EXPECT_EQ(watch.see(1, 5, 8).seq, 15);
  EXPECT_EQ(watch.see(1, 1, 9).seq, 16);
}

TEST(SequenceWatch, DoesNotBelieveANumberThatNobodyCanHaveComeTo) {
  SequenceWatch watch;
  double now_s = 100.0;
  for (std::uint64_t seq = 1; seq <= 50; ++seq) EXPECT_TRUE(watch.see(1, seq, 7, now_s += 0.02).believed);
  for (const std::uint64_t forged : {71776119061217107u, 1ul << 63, 1ul << 35, 1000ul})
    EXPECT_FALSE(watch.see(1, forged, 7, now_s).believed) << forged;
  const auto next = watch.see(1, 51, 7, now_s + 0.02);
  EXPECT_TRUE(next.believed);
  EXPECT_EQ(next.gap, 0);
  EXPECT_FALSE(next.out_of_order);
}

TEST(SequenceWatch, BelievesAJumpThatItsSuccessorConfirms) {
  SequenceWatch watch;
  watch.see(1, 1, 7, 100.0);
  EXPECT_FALSE(watch.see(1, 5000, 7, 100.1).believed);
  const auto confirmed = watch.see(1, 5002, 7, 100.12);
  EXPECT_TRUE(confirmed.believed);
  EXPECT_EQ(confirmed.gap, 1) << "the jump itself is no loss";
  EXPECT_EQ(watch.see(1, 5003, 7, 100.14).gap, 0);
}

TEST(SequenceWatch, ALongSilenceMayHideMany) {
  SequenceWatch watch;
  watch.see(1, 1, 7, 100.0);
  const auto later = watch.see(1, 502, 7, 110.0);
  EXPECT_TRUE(later.believed);
  EXPECT_EQ(later.gap, 500);
}

TEST(SequenceWatch, AWriterThatComesBackAfterAnOutageHasItsNumbersMissing) {
  SequenceWatch watch;
  double now_s = 100.0;
  for (std::uint64_t seq = 1; seq <= 50; ++seq) watch.see(1, seq, 7, now_s += 0.02);
  const auto back = watch.see(1, 751, 7, now_s += 14.0);
  EXPECT_TRUE(back.believed);
  EXPECT_EQ(back.gap, 700);
  EXPECT_EQ(back.seq, 751);
}

TEST(SequenceWatch, WhoStoodStillAndTakesWhatWaitedMissesWhatCameAfterIt) {
  SequenceWatch watch;
  double said_s = 100.0;
  for (std::uint64_t seq = 1; seq <= 50; ++seq) watch.see(1, seq, 7, said_s, said_s += 0.02);
  const double back_s = said_s + 16.0;
  for (std::uint64_t seq = 51; seq <= 60; ++seq) EXPECT_EQ(watch.see(1, seq, 7, back_s, said_s += 0.02).gap, 0);
  const auto next = watch.see(1, 850, 7, back_s, back_s);
  EXPECT_TRUE(next.believed);
  EXPECT_EQ(next.gap, 789);
}

TEST(SequenceWatch, ANodeThatIsStartedAnewDuringAnOutageIsNoGap) {
  SequenceWatch watch;
  double now_s = 100.0;
  for (std::uint64_t seq = 1; seq <= 50; ++seq) watch.see(1, seq, 7, now_s += 0.02);
  const auto again = watch.see(1, 3, 8, now_s += 14.0);
  EXPECT_EQ(again.gap, 0);
  EXPECT_EQ(again.seq, 53);
}

TEST(SequenceWatch, WhatComesLateFillsItsGapAndWhatComesAgainDoesNot) {
  SequenceWatch watch;
  watch.see(1, 1, 7);
  EXPECT_EQ(watch.see(1, 6, 7).gap, 4);
  for (const std::uint64_t late : {3u, 2u, 5u}) {
    const auto finding = watch.see(1, late, 7);
    EXPECT_TRUE(finding.filled && finding.out_of_order && !finding.repeated) << late;
    EXPECT_EQ(finding.seq, static_cast<std::int64_t>(late));
  }
  for (const std::uint64_t again : {3u, 1u, 6u}) {
    const auto finding = watch.see(1, again, 7);
    EXPECT_TRUE(finding.repeated && finding.out_of_order && !finding.filled) << again;
  }
  EXPECT_TRUE(watch.see(1, 4, 7).filled);
}

TEST(SequenceWatch, WhatWasWrittenBeforeTheFirstThatWasHeardIsNoRepetition) {
  SequenceWatch watch;
  watch.see(1, 5, 7);
  const auto earlier = watch.see(1, 4, 7);
  EXPECT_TRUE(earlier.out_of_order);
  EXPECT_FALSE(earlier.repeated || earlier.filled);
}

TEST(SequenceWatch, NoRobotHasTheNumber0) {
  SequenceWatch watch;
  EXPECT_FALSE(watch.see(0, 1, 8).believed);
}

TEST(SequenceWatch, NumbersStayUniqueHoweverOftenWritersRestart) {
  SequenceWatch watch;
  std::mt19937_64 random{1};
  std::set<std::int64_t> seen;
  std::int64_t last = 0;
  for (std::uint64_t writer = 1; writer <= 50; ++writer) {
    std::uint64_t seq = 0;
    for (std::uint64_t i = 0; i < random() % 20; ++i) {
      seq += 1 + random() % 3;
      const auto finding = watch.see(1, seq, writer);
      EXPECT_TRUE(seen.insert(finding.seq).second);
      EXPECT_GT(finding.seq, last);
      last = finding.seq;
    }
  }
}

TEST(SequenceWatch, TwoWritersThatSpeakInTurnLoseNothingAndShareNoNumber) {
  SequenceWatch watch;
  std::set<std::int64_t> seen;
  for (std::uint64_t seq = 1; seq <= 100; ++seq) {
    for (const std::uint64_t writer : {7u, 8u}) {
      const auto finding = watch.see(1, writer == 7 ? 5000 + seq : seq, writer);
      EXPECT_EQ(finding.gap, 0);
      EXPECT_FALSE(finding.out_of_order);
      EXPECT_TRUE(seen.insert(finding.seq).second);
    }
  }
  EXPECT_EQ(*seen.rbegin(), 5000 + 200) << "numbers rise by what was written";
}

TEST(SequenceWatch, WhatOneOfTwoWritersSkippedIsMissingAndMayComeLate) {
  SequenceWatch watch;
  watch.see(1, 1, 7);
  watch.see(1, 1, 8);
  EXPECT_EQ(watch.see(1, 4, 7).gap, 2);
  const auto other = watch.see(1, 2, 8);
  const auto late = watch.see(1, 2, 7);
  EXPECT_TRUE(late.filled);
  EXPECT_NE(late.seq, other.seq);
  EXPECT_TRUE(watch.see(1, 2, 7).repeated);
  EXPECT_EQ(watch.see(1, 5, 7).gap, 0);
}

TEST(SequenceWatch, OfVeryManyWritersTheOneNotHeardForLongestIsForgotten) {
  SequenceWatch watch;
  watch.see(1, 1, 7);
  for (std::uint64_t forged = 100; forged < 115; ++forged) watch.see(1, 1, forged);
  EXPECT_EQ(watch.see(1, 3, 7).gap, 1) << "sixteen are known";
  for (std::uint64_t forged = 200; forged < 216; ++forged) watch.see(1, 1, forged);
  EXPECT_EQ(watch.see(1, 6, 7).gap, 0) << "it began again";
}

}  // namespace
}  // namespace trivela::robot
