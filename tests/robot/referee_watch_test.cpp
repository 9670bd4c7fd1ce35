#include "robot/watch/referee_watch.hpp"

#include <gtest/gtest.h>

#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

msg::Referee word(std::int64_t t_ns, bool playing) {
  msg::Referee out{};
  out.t_ns = t_ns;
  out.playing = playing;
  return out;
}

TEST(RefereeWatch, SaysNothingBeforeTheFirstWord) {
  const RefereeWatch watch{1.0};
  EXPECT_EQ(watch.says(5 * kSecond_ns), RefereePermission::kNothing);
}

TEST(RefereeWatch, PlayCountsForItsTimeAndStopForEver) {
  RefereeWatch watch{1.0};
  watch.received(word(10 * kSecond_ns, true), 10 * kSecond_ns);
  EXPECT_EQ(watch.says(11 * kSecond_ns), RefereePermission::kPlay);
  EXPECT_EQ(watch.says(11 * kSecond_ns + 1), RefereePermission::kSilent);
  watch.received(word(12 * kSecond_ns, true), 12 * kSecond_ns);
  EXPECT_EQ(watch.says(12 * kSecond_ns), RefereePermission::kPlay) << "the word is back";
  watch.received(word(13 * kSecond_ns, false), 13 * kSecond_ns);
  EXPECT_EQ(watch.says(100 * kSecond_ns), RefereePermission::kStop);
}

TEST(RefereeWatch, AWordThatWaitedIsAsOldAsItIs) {
  RefereeWatch watch{1.0};
  watch.received(word(10 * kSecond_ns, true), 12 * kSecond_ns);
  EXPECT_EQ(watch.says(12 * kSecond_ns), RefereePermission::kSilent);
}

TEST(RefereeWatch, AWordFromTheFutureCountsNoLongerThanOneOfNow) {
  RefereeWatch watch{1.0};
  watch.received(word(1000 * kSecond_ns, true), 10 * kSecond_ns);
  EXPECT_EQ(watch.says(11 * kSecond_ns), RefereePermission::kPlay);
  EXPECT_EQ(watch.says(12 * kSecond_ns), RefereePermission::kSilent);
}

TEST(RefereeWatch, WithoutAWriterThatLivesHisWordIsVoidUntilTheNext) {
  RefereeWatch watch{1.0};
  watch.received(word(10 * kSecond_ns, true), 10 * kSecond_ns);
  watch.writers(1);
  EXPECT_EQ(watch.says(10 * kSecond_ns), RefereePermission::kPlay) << "another one is there";
  watch.writers(0);
  EXPECT_EQ(watch.says(10 * kSecond_ns), RefereePermission::kSilent);
  watch.writers(1);
  EXPECT_EQ(watch.says(10 * kSecond_ns), RefereePermission::kSilent) << "he has not spoken again";
  watch.received(word(10 * kSecond_ns + 5, true), 10 * kSecond_ns + 5);
  EXPECT_EQ(watch.says(10 * kSecond_ns + 5), RefereePermission::kPlay);
}

TEST(RefereeWatch, OfTwoWritersTheStricterWordCounts) {
  RefereeWatch watch{1.0};
  constexpr std::uint64_t kBox = 1, kForger = 2;
  watch.received(word(10 * kSecond_ns, false), 10 * kSecond_ns, kBox);
  EXPECT_FALSE(watch.news(10 * kSecond_ns));
  for (std::int64_t t_ns = 10 * kSecond_ns + 1; t_ns < 13 * kSecond_ns; t_ns += kSecond_ns / 2) {
    watch.received(word(t_ns, false), t_ns, kBox);
    watch.received(word(t_ns + 1, true), t_ns + 1, kForger);
    EXPECT_EQ(watch.says(t_ns + 1), RefereePermission::kStop);
    EXPECT_EQ(watch.news(t_ns + 1).has_value(), t_ns == 10 * kSecond_ns + 1) << "said once";
  }
  watch.received(word(14 * kSecond_ns, true), 14 * kSecond_ns, kForger);
  EXPECT_EQ(watch.says(14 * kSecond_ns), RefereePermission::kPlay) << "the other has said nothing for its time";
  EXPECT_EQ(watch.news(14 * kSecond_ns), "one program writes referee again");
}

TEST(RefereeWatch, AnotherWritersStopHoldsAtOnce) {
  RefereeWatch watch{1.0};
  watch.received(word(10 * kSecond_ns, true), 10 * kSecond_ns, 1);
  watch.received(word(10 * kSecond_ns, false), 10 * kSecond_ns, 2);
  EXPECT_EQ(watch.says(10 * kSecond_ns), RefereePermission::kStop);
  watch.received(word(10 * kSecond_ns + 1, true), 10 * kSecond_ns + 1, 1);
  EXPECT_EQ(watch.says(10 * kSecond_ns + 1), RefereePermission::kStop);
}

TEST(RefereeWatch, TellsEachEdgeOnce) {
  RefereeWatch watch{1.0};
  watch.received(word(10 * kSecond_ns, true), 10 * kSecond_ns);
  EXPECT_FALSE(watch.news(11 * kSecond_ns));
  EXPECT_EQ(watch.news(12 * kSecond_ns),
            "the referee is silent, its last command is of 2.00 s ago: the game counts as stopped");
  EXPECT_FALSE(watch.news(13 * kSecond_ns));
  watch.received(word(14 * kSecond_ns, true), 14 * kSecond_ns);
  EXPECT_EQ(watch.news(14 * kSecond_ns), "the referee is received again");
  EXPECT_FALSE(watch.news(14 * kSecond_ns));
}

}  // namespace
}  // namespace trivela::robot
