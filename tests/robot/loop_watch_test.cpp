#include "robot/watch/decision_watch.hpp"

#include <gtest/gtest.h>

namespace trivela::robot {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

TEST(LoopWatch, ALoopThatWaitsForItsFirstWorldStateIsNotSilent) {
  LoopWatch watch;
  EXPECT_FALSE(watch.fell_silent(1, 0, 0));
  EXPECT_FALSE(watch.fell_silent(0, 1, 100 * kMillisecond_ns));
}

TEST(LoopWatch, OneThatSpokeAfterwardsFallsSilentEachTime) {
  LoopWatch watch;
  EXPECT_FALSE(watch.fell_silent(1, 0, 0));
  EXPECT_FALSE(watch.fell_silent(0, 1, 100 * kMillisecond_ns));
  for (const std::int64_t t_ms : {5000, 9000}) {
    EXPECT_FALSE(watch.fell_silent(1, 0, t_ms * kMillisecond_ns)) << "it returns";
    EXPECT_TRUE(watch.fell_silent(0, 1, (t_ms + 120) * kMillisecond_ns));
  }
}

TEST(LoopWatch, OneThatSpeaksFromItsBirthFallsSilent) {
  LoopWatch watch;
  EXPECT_FALSE(watch.fell_silent(1, 0, 0));
  EXPECT_TRUE(watch.fell_silent(0, 1, 2000 * kMillisecond_ns));
}

TEST(LoopWatch, OneThatLeavesIsGoneAndItsSuccessorBeginsAnew) {
  LoopWatch watch;
  EXPECT_FALSE(watch.fell_silent(1, 0, 0));
  EXPECT_FALSE(watch.fell_silent(0, 0, 2000 * kMillisecond_ns)) << "it said goodbye";
  EXPECT_FALSE(watch.fell_silent(1, 0, 3000 * kMillisecond_ns));
  EXPECT_FALSE(watch.fell_silent(0, 1, 3100 * kMillisecond_ns));
}

TEST(LoopWatch, ASecondWriterIsNoReturnOfTheFirst) {
  LoopWatch watch;
  EXPECT_FALSE(watch.fell_silent(1, 0, 0));
  EXPECT_FALSE(watch.fell_silent(0, 1, 100 * kMillisecond_ns));
  EXPECT_FALSE(watch.fell_silent(1, 1, 200 * kMillisecond_ns));
  EXPECT_FALSE(watch.fell_silent(0, 2, 300 * kMillisecond_ns));
}

}  // namespace
}  // namespace trivela::robot
