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
  EXPECT_EQ(watch.says(5 * kSecond_ns), RefereeSays::kNothing);
}

TEST(RefereeWatch, PlayCountsForItsTimeAndStopForEver) {
  RefereeWatch watch{1.0};
  watch.heard(word(10 * kSecond_ns, true), 10 * kSecond_ns);
  EXPECT_EQ(watch.says(11 * kSecond_ns), RefereeSays::kPlay);
  EXPECT_EQ(watch.says(11 * kSecond_ns + 1), RefereeSays::kSilent);
  watch.heard(word(12 * kSecond_ns, true), 12 * kSecond_ns);
  EXPECT_EQ(watch.says(12 * kSecond_ns), RefereeSays::kPlay) << "the word is back";
  watch.heard(word(13 * kSecond_ns, false), 13 * kSecond_ns);
  EXPECT_EQ(watch.says(100 * kSecond_ns), RefereeSays::kStop);
}

TEST(RefereeWatch, AWordThatWaitedIsAsOldAsItIs) {
  RefereeWatch watch{1.0};
  watch.heard(word(10 * kSecond_ns, true), 12 * kSecond_ns);
  EXPECT_EQ(watch.says(12 * kSecond_ns), RefereeSays::kSilent);
}

TEST(RefereeWatch, AWordFromTheFutureCountsNoLongerThanOneOfNow) {
  RefereeWatch watch{1.0};
  watch.heard(word(1000 * kSecond_ns, true), 10 * kSecond_ns);
  EXPECT_EQ(watch.says(11 * kSecond_ns), RefereeSays::kPlay);
  EXPECT_EQ(watch.says(12 * kSecond_ns), RefereeSays::kSilent);
}

TEST(RefereeWatch, WithoutAWriterThatLivesHisWordIsVoidUntilTheNext) {
  RefereeWatch watch{1.0};
  watch.heard(word(10 * kSecond_ns, true), 10 * kSecond_ns);
  watch.writers(1);
  EXPECT_EQ(watch.says(10 * kSecond_ns), RefereeSays::kPlay) << "another one is there";
  watch.writers(0);
  EXPECT_EQ(watch.says(10 * kSecond_ns), RefereeSays::kSilent);
  watch.writers(1);
  EXPECT_EQ(watch.says(10 * kSecond_ns), RefereeSays::kSilent) << "he has not spoken again";
  watch.heard(word(10 * kSecond_ns + 5, true), 10 * kSecond_ns + 5);
  EXPECT_EQ(watch.says(10 * kSecond_ns + 5), RefereeSays::kPlay);
}

TEST(RefereeWatch, TellsEachEdgeOnce) {
  RefereeWatch watch{1.0};
  watch.heard(word(10 * kSecond_ns, true), 10 * kSecond_ns);
  EXPECT_FALSE(watch.news(11 * kSecond_ns));
  EXPECT_EQ(watch.news(12 * kSecond_ns),
            "the referee is silent, his last word is of 2.00 s ago: the game counts as stopped");
  EXPECT_FALSE(watch.news(13 * kSecond_ns));
  watch.heard(word(14 * kSecond_ns, true), 14 * kSecond_ns);
  EXPECT_EQ(watch.news(14 * kSecond_ns), "the referee is heard again");
  EXPECT_FALSE(watch.news(14 * kSecond_ns));
}

}  // namespace
}  // namespace trivela::robot
