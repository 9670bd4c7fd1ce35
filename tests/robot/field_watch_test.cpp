#include "robot/belief/field_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace trivela::robot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class FieldWatchTest : public testing::Test {
 protected:
  FieldWatchTest() {
    world.playing = true;
    nobody_sees_the_ball();
  }

  void nobody_sees_the_ball() {
    world.ball_known = false;
    world.ball_x_m = world.ball_y_m = std::numeric_limits<double>::quiet_NaN();
  }
  void robot_at(double x_m, double y_m) {
    world.x_m = x_m;
    world.y_m = y_m;
  }
  void ball_at(double x_m, double y_m) {
    world.ball_known = true;
    world.ball_x_m = x_m;
    world.ball_y_m = y_m;
  }

  /// What is said in so long a time, a cycle of 20 ms after the other.
  std::vector<std::string> said_in(double time_s) {
    std::vector<std::string> all;
    for (const std::int64_t until_ns = world.t_ns + static_cast<std::int64_t>(time_s * 1e9); world.t_ns < until_ns;) {
      world.t_ns += 20'000'000;
      for (std::string& sentence : watch.see(world)) all.push_back(std::move(sentence));
    }
    return all;
  }

  FieldWatch watch{9.0, 6.0};
  msg::WorldState world{};
};

TEST_F(FieldWatchTest, ARobotThatPlaysOnALargerFieldIsSaidOnceAnEpisode) {
  robot_at(0.0, -10.4);
  EXPECT_THAT(said_in(1.9), testing::IsEmpty());
  EXPECT_THAT(said_in(60.0),
              ElementsAre(testing::AllOf(HasSubstr("the robot has been outside the field of 18.0 x 12.0 m"),
                                         HasSubstr("1.4 m beyond a line"))));
  robot_at(0.0, -8.0);
  EXPECT_THAT(said_in(1.0), testing::IsEmpty());
  robot_at(7.2, 0.0);
  EXPECT_THAT(said_in(3.0), ElementsAre(HasSubstr("now at (7.2, 0.0) m")));
}

TEST_F(FieldWatchTest, ABallIsWatchedBesideTheRobot) {
  ball_at(0.0, 11.0);
  EXPECT_THAT(said_in(10.0), ElementsAre(HasSubstr("the ball has been outside")));
  nobody_sees_the_ball();
  EXPECT_THAT(said_in(10.0), testing::IsEmpty());
}

TEST_F(FieldWatchTest, NothingIsSaidOfWhatAMatchBrings) {
  robot_at(6.6, 9.8);
  EXPECT_THAT(said_in(10.0), testing::IsEmpty()) << "just outside";
  robot_at(0.0, 12.0);
  ball_at(0.0, 12.0);
  EXPECT_THAT(said_in(1.8), testing::IsEmpty()) << "for a moment";
  robot_at(0.0, 0.0);
  ball_at(0.0, 8.0);
  said_in(0.02);
  world.playing = false;
  robot_at(0.0, 12.0);
  EXPECT_THAT(said_in(60.0), testing::IsEmpty()) << "parked while the game stands";
}

TEST_F(FieldWatchTest, AStopEndsAnEpisode) {
  robot_at(0.0, 12.0);
  EXPECT_EQ(said_in(3.0).size(), 1U);
  world.playing = false;
  said_in(0.1);
  world.playing = true;
  EXPECT_EQ(said_in(3.0).size(), 1U);
}

}  // namespace
}  // namespace trivela::robot
