#include "robot/belief/possession_count.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

// A robot that has the ball in a half that it has heard from its beginning.
struct Half {
  PossessionCount count;
  PossessionSigns now{.t_ns = 1'000'000'000,
                      .half = 1,
                      .playing = false,
                      .half_time_s = std::numeric_limits<double>::quiet_NaN(),
                      .possession = true,
                      .kick_id = 0};

  std::uint32_t cycles(int n = 1) {
    std::uint32_t number = 0;
    for (int i = 0; i < n; ++i) {
      now.t_ns += kCycle_ns;
      number = count.see(now);
    }
    return number;
  }

  std::uint32_t play(bool playing) {
    now.playing = playing;
    return cycles(5);
  }

  std::uint32_t without_ball(int n) {
    now.possession = false;
    const std::uint32_t number = cycles(n);
    now.possession = true;
    return number;
  }
};

TEST(PossessionCount, CountsFromOneWithTheStopThatEndsOne) {
  Half half;
  EXPECT_EQ(half.cycles(), 1u) << "laid in the handler for the restart";
  EXPECT_EQ(half.play(true), 1u);
  EXPECT_EQ(half.play(false), 2u);
  EXPECT_EQ(half.play(true), 2u);
  EXPECT_EQ(half.play(false), 3u);
}

TEST(PossessionCount, ABallAwayForLessThanHalfASecondIsTheSamePossession) {
  Half half;
  half.play(true);
  for (const int cycles : {1, 5, 23}) {
    EXPECT_EQ(half.without_ball(cycles), 1u);
    EXPECT_EQ(half.cycles(), 1u) << cycles;
  }
  EXPECT_EQ(half.without_ball(24), 1u) << "as long as nobody has it";
  EXPECT_EQ(half.cycles(), 2u);
}

TEST(PossessionCount, ABallThatComesBackFromAKickIsAnotherPossession) {
  Half half;
  half.play(true);
  half.now.kick_id = 77;
  EXPECT_EQ(half.cycles(4), 1u) << "the coil moves";
  EXPECT_EQ(half.without_ball(6), 1u);
  EXPECT_EQ(half.cycles(), 2u);
  EXPECT_EQ(half.without_ball(6), 2u);
  EXPECT_EQ(half.cycles(20), 2u) << "a kick ends one possession";
}

TEST(PossessionCount, AKickThatMovedNoBallEndsNone) {
  Half half;
  half.play(true);
  half.now.kick_id = 77;
  EXPECT_EQ(half.cycles(60), 1u);
  half.without_ball(6);
  EXPECT_EQ(half.cycles(), 1u) << "over a second later";
}

TEST(PossessionCount, WhatWasNeverInPlayIsNumberedOnce) {
  Half half;
  half.play(true);
  half.play(false);
  half.without_ball(100);
  EXPECT_EQ(half.cycles(), 2u) << "the ball was put elsewhere and back";
  half.now.possession = false;
  EXPECT_EQ(half.play(true), 2u) << "the others play it";
  EXPECT_EQ(half.play(false), 2u);
  half.now.possession = true;
  EXPECT_EQ(half.play(true), 2u);
}

TEST(PossessionCount, AnotherHalfIsCountedAnew) {
  Half half;
  half.play(true);
  half.play(false);
  half.play(true);
  half.now.half = 2;
  EXPECT_EQ(half.cycles(), 1u);
  half.now.playing = false;
  EXPECT_EQ(half.cycles(), 2u);
}

TEST(PossessionCount, WhoBeginsInTheMiddleOfAHalfRepeatsNoNumber) {
  Half before;
  std::uint32_t last = 0;
  for (int i = 0; i < 20; ++i) {
    before.play(true);
    last = before.play(false);
  }
  Half after;
  after.now.half_time_s = 20 * 10 * 0.02;
  EXPECT_GT(after.cycles(), last);
  EXPECT_EQ(after.cycles(), after.count.see(after.now));
  Half odd;
  odd.now.half_time_s = std::numeric_limits<double>::infinity();
  EXPECT_EQ(odd.cycles(), 1u) << "a half's time that is none";
}

}  // namespace
}  // namespace trivela::robot
