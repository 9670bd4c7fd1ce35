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

class ReachWatchTest : public testing::Test {
 protected:
  ReachWatchTest() {
    world.half = 1;
    world.playing = true;
    world.ball_x_m = world.ball_y_m = std::numeric_limits<double>::quiet_NaN();
  }

  /// What is said in so long a time, a second a step.
  std::vector<std::string> said_in(int time_s) {
    std::vector<std::string> all;
    for (int i = 0; i < time_s; ++i) {
      world.t_ns += 1'000'000'000;
      if (auto sentence = watch.see(world)) all.push_back(std::move(*sentence));
    }
    return all;
  }

  void robot_was_at(double x_m, double y_m) {
    world.x_m = x_m;
    world.y_m = y_m;
    said_in(1);
    world.x_m = world.y_m = 0.0;
  }

  ReachWatch watch{11.0, 7.0};
  msg::WorldState world{};
};

TEST_F(ReachWatchTest, PlayThatNeverComesNearTheLinesIsSaidOnceAHalf) {
  robot_was_at(-6.0, 9.0);
  EXPECT_THAT(said_in(590), IsEmpty());
  EXPECT_THAT(said_in(600),
              ElementsAre(AllOf(HasSubstr("6.0 m across and 9.0 m along"), HasSubstr("the field of 22.0 x 14.0 m"))));
  world.half = 2;
  EXPECT_THAT(said_in(590), IsEmpty());
  EXPECT_EQ(said_in(60).size(), 1U);
}

TEST_F(ReachWatchTest, ARobotOrABallNearBothLinesIsEnough) {
  robot_was_at(5.6, 0.0);
  world.ball_known = true;
  world.ball_x_m = 0.0;
  world.ball_y_m = -9.6;
  said_in(1);
  world.ball_known = false;
  world.ball_y_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(said_in(3000), IsEmpty());
}

TEST_F(ReachWatchTest, OneLineIsNotEnough) {
  robot_was_at(7.0, 0.0);
  EXPECT_THAT(said_in(700), ElementsAre(HasSubstr("7.0 m across and 0.0 m along")));
}

TEST_F(ReachWatchTest, TheTimeOfPlayCounts) {
  said_in(500);
  world.playing = false;
  EXPECT_THAT(said_in(3000), IsEmpty()) << "the game stands";
  world.playing = true;
  EXPECT_THAT(said_in(90), IsEmpty());
  EXPECT_EQ(said_in(20).size(), 1U);
}

}  // namespace
}  // namespace trivela::robot
