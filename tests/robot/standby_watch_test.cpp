#include "robot/watch/decision_watch.hpp"

#include <gtest/gtest.h>

#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

/// Lets `cycles` pass, in each of which the first one speaks or not; whether the second was in charge in the last.
bool pass(StandbyWatch& watch, std::int64_t& now_ns, int cycles, bool first_speaks) {
  bool in_charge = false;
  for (int i = 0; i < cycles; ++i) {
    now_ns += kCycle_ns;
    if (first_speaks) watch.received(now_ns);
    in_charge = watch.in_charge(now_ns);
  }
  return in_charge;
}

TEST(StandbyWatch, WaitsWhileTheFirstSpeaks) {
  StandbyWatch watch;
  std::int64_t now_ns = 0;
  for (int i = 0; i < 500; ++i) EXPECT_FALSE(pass(watch, now_ns, 1, true)) << i;
}

TEST(StandbyWatch, TakesOverInTheSixthCycleWithoutAWord) {
  StandbyWatch watch;
  std::int64_t now_ns = 0;
  pass(watch, now_ns, 100, true);
  EXPECT_FALSE(pass(watch, now_ns, 5, false));
  EXPECT_TRUE(pass(watch, now_ns, 1, false));
}

TEST(StandbyWatch, LeavesTheFirstASecondToBegin) {
  StandbyWatch watch;
  std::int64_t now_ns = 0;
  EXPECT_FALSE(pass(watch, now_ns, 51, false));
  EXPECT_TRUE(pass(watch, now_ns, 1, false));
}

TEST(StandbyWatch, GivesBackAfterItHasHeardTheFirstForTwoSeconds) {
  StandbyWatch watch;
  std::int64_t now_ns = 0;
  pass(watch, now_ns, 100, true);
  ASSERT_TRUE(pass(watch, now_ns, 500, false));
  EXPECT_TRUE(pass(watch, now_ns, 100, true));
  EXPECT_FALSE(pass(watch, now_ns, 1, true));
}

TEST(StandbyWatch, ASilenceWhileTheFirstReturnsBeginsTheTwoSecondsAnew) {
  StandbyWatch watch;
  std::int64_t now_ns = 0;
  pass(watch, now_ns, 100, true);
  pass(watch, now_ns, 500, false);
  pass(watch, now_ns, 90, true);
  pass(watch, now_ns, 6, false);
  EXPECT_TRUE(pass(watch, now_ns, 90, true));
  EXPECT_FALSE(pass(watch, now_ns, 11, true));
}

}  // namespace
}  // namespace trivela::robot
