#include "robot/belief/field_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace trivela::robot {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class GoalWatchTest : public testing::Test {
 protected:
  GoalWatchTest() {
    world.playing = word.playing = true;
    world.ball_age_s = 0.0;
  }

  /// What is said in a cycle of 20 ms with the ball there.
  void ball_at(double x_m, double y_m) {
    world.ball_known = true;
    world.ball_x_m = x_m;
    world.ball_y_m = y_m;
    look();
  }

  void look() {
    world.t_ns += 20'000'000;
    if (auto sentence = watch.see(world, &word)) said.push_back(std::move(*sentence));
  }

  /// The ball rolls over a goal line there.
  void crosses_at(double x_m, double side = 1.0) {
    for (const double y_m : {8.5, 8.9, 9.3, 9.5}) ball_at(x_m, side * y_m);
  }

  void play_is(bool on) {
    world.playing = word.playing = on;
    look();
  }

  void goal_for_us() {
    ++word.goals_own;
    look();
  }

  GoalWatch watch{{.y_m = 9.0, .half_width_m = 1.0}};
  msg::WorldState world{};
  msg::Referee word{};
  std::vector<std::string> said;
};

TEST_F(GoalWatchTest, AGoalThatIsGivenForABallBesideTheGoalIsSaidOnce) {
  crosses_at(2.0);
  play_is(false);
  goal_for_us();
  look();
  EXPECT_THAT(said, ElementsAre(AllOf(HasSubstr("crossed the goal line at x = 2.0 m"), HasSubstr("goal of 2.0 m"))));
}

TEST_F(GoalWatchTest, TheCrossingLiesBetweenTwoSights) {
  ball_at(1.2, 8.5);
  ball_at(2.2, 9.5);
  goal_for_us();
  EXPECT_THAT(said, ElementsAre(HasSubstr("at x = 1.7 m")));
}

TEST_F(GoalWatchTest, AGoalWithinTheGoalOrNearAPostIsNone) {
  for (const double x_m : {0.0, -0.9, 1.4}) {
    crosses_at(x_m);
    play_is(false);
    goal_for_us();
    play_is(true);
  }
  EXPECT_THAT(said, IsEmpty());
}

TEST_F(GoalWatchTest, ABallBesideTheGoalWithoutAGoalIsNone) {
  crosses_at(3.0);
  play_is(false);
  play_is(true);
  EXPECT_THAT(said, IsEmpty());
  goal_for_us();
  EXPECT_THAT(said, IsEmpty()) << "of another ball, that nobody saw";
}

TEST_F(GoalWatchTest, TheOpponentsGoalsAreOfTheOtherLine) {
  crosses_at(2.0, -1.0);
  goal_for_us();
  EXPECT_THAT(said, IsEmpty()) << "it crossed our own line";
  ++word.goals_other;
  look();
  EXPECT_THAT(said, ElementsAre(HasSubstr("x = 2.0 m")));
}

TEST_F(GoalWatchTest, WhatIsLongAgoOrWasNotSeenIsNotKnown) {
  crosses_at(2.0);
  world.ball_known = false;
  world.ball_x_m = world.ball_y_m = std::numeric_limits<double>::quiet_NaN();
  world.t_ns += 11'000'000'000;
  goal_for_us();
  EXPECT_THAT(said, IsEmpty()) << "eleven seconds later";
  ball_at(2.0, 8.5);
  world.t_ns += 1'000'000'000;
  ball_at(2.0, 9.5);
  goal_for_us();
  EXPECT_THAT(said, IsEmpty()) << "a second without a sight";
  EXPECT_FALSE(watch.see(world, nullptr));
}

}  // namespace
}  // namespace trivela::robot
