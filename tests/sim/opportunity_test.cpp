#include "sim/opportunity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/opponent_body.hpp"

namespace trivela::sim {
namespace {

TEST(Opportunity, FollowsTheScenariosDistributions) {
  const Scenario s;
  constexpr std::uint32_t kCount = 4000;
  std::vector<double> opponents;
  double aim = 0, aim2 = 0, distance = 0, bearing = 0;
  for (std::uint32_t i = 1; i <= kCount; ++i) {
    const Opportunity o = draw_opportunity(s, kicking::Draws{1, i});
    const double h = o.start.heading_rad;
    const double ball_x = o.start.x_m - 0.27 * std::sin(h), ball_y = o.start.y_m + 0.27 * std::cos(h);
    ASSERT_LE(std::abs(ball_x), 3.0);
    ASSERT_GE(9.0 - ball_y, 3.0 - 1e-9);
    ASSERT_LE(9.0 - ball_y, 9.0 + 1e-9);
    distance += 9.0 - ball_y;
    const double speed = std::hypot(o.velocity.vx_mps, o.velocity.vy_mps);
    ASSERT_GE(speed, 0.3);
    ASSERT_LE(speed, 2.0);
    ASSERT_GE(o.opponents[0].closing_mps, 0.8);
    ASSERT_LE(o.opponents[0].closing_mps, 2.0);
    const double error = kicking::wrap_angle(h - std::atan2(ball_x, 9.0 - ball_y));
    aim += error;
    aim2 += error * error;
    bearing += o.opponents[0].bearing_rad;
    opponents.push_back(o.opponents[0].distance_m);
  }
  std::sort(opponents.begin(), opponents.end());
  EXPECT_NEAR(opponents[kCount / 2], 1.5, 0.06);
  EXPECT_NEAR(std::log(opponents[kCount * 3 / 4] / opponents[kCount / 4]), 2 * 0.6745 * 0.55, 0.05);
  EXPECT_NEAR(distance / kCount, 6.0, 0.11);
  EXPECT_NEAR(aim / kCount, 0.0, 0.08);
  EXPECT_NEAR(std::sqrt(aim2 / kCount), 1.19, 0.05);  // N(0, 70 degrees) wrapped to half a turn
  EXPECT_NEAR(bearing / kCount, 0.0, 0.12);
}

TEST(Opportunity, WithoutAimErrorFacesTheGoalCentre) {
  Scenario s;
  s.possession.aim_error_sd_rad = 0.0;
  for (std::uint32_t i = 1; i <= 50; ++i) {
    const auto start = draw_opportunity(s, kicking::Draws{1, i}).start;
    const double reach = (9.0 - start.y_m) / std::cos(start.heading_rad);
    EXPECT_NEAR(start.x_m - std::sin(start.heading_rad) * reach, 0.0, 1e-9);
  }
}

TEST(OpponentBody, ClosesInOnAMovingBallAndStopsAtIt) {
  OpponentBody body;
  body.place({1.0, 2.0, 0.11}, {2.0, -M_PI / 2, 1.5});
  EXPECT_NEAR(body.position().x_m, 3.0, 1e-12);
  EXPECT_NEAR(body.position().y_m, 2.0, 1e-12);
  body.close_in({1.0, 3.0, 0.11}, 1.0);
  EXPECT_NEAR(body.distance_m(), 0.5, 1e-12);
  EXPECT_NEAR(body.position().x_m, 1.5, 1e-12);
  EXPECT_NEAR(body.position().y_m, 3.0, 1e-12);
  body.close_in({1.0, 3.0, 0.11}, 1.0);
  EXPECT_EQ(body.distance_m(), 0.0);
}

TEST(Opportunity, FurtherOpponentsAreNotNearerThanTheNearest) {
  Scenario s;
  s.opponent.count = 5;
  double farther = 0.0;
  for (std::uint32_t i = 1; i <= 500; ++i) {
    const Opportunity one = draw_opportunity({}, kicking::Draws{1, i}),
                      five = draw_opportunity(s, kicking::Draws{1, i});
    ASSERT_EQ(five.opponent_count, 5U);
    EXPECT_EQ(five.opponents[0].distance_m, one.opponents[0].distance_m);  // more of them shift nothing
    EXPECT_EQ(five.start.x_m, one.start.x_m);
    for (std::size_t j = 1; j < 5; ++j) {
      EXPECT_GE(five.opponents[j].distance_m, five.opponents[0].distance_m);
      EXPECT_NE(five.opponents[j].bearing_rad, five.opponents[0].bearing_rad);
      farther += five.opponents[j].distance_m / 2000.0;
    }
  }
  EXPECT_GT(farther, 4.0);
}

TEST(Opportunity, EveryRobotOfTheTeamGainsTheBallAlikeOften) {
  Scenario s;
  s.team.robots = 5;
  std::array<int, 6> gained{};
  for (std::uint32_t i = 1; i <= 2000; ++i) ++gained.at(draw_opportunity(s, kicking::Draws{1, i}).robot);
  EXPECT_EQ(gained[0], 0);
  for (std::size_t robot = 1; robot <= 5; ++robot) EXPECT_NEAR(gained[robot], 400, 72);  // four sd
  EXPECT_EQ(draw_opportunity({}, kicking::Draws{1, 1}).robot, 1);
}

TEST(Opportunity, TheRefereeWhistlesAtItsRate) {
  Scenario s;
  s.referee.stops_per_min = 30.0;
  double sum = 0.0;
  for (std::uint32_t i = 1; i <= 4000; ++i) sum += draw_opportunity(s, kicking::Draws{1, i}).whistle_s;
  EXPECT_NEAR(sum / 4000, 2.0, 0.13);
  s.referee.stops_per_min = 0.0;
  EXPECT_TRUE(std::isinf(draw_opportunity(s, kicking::Draws{1, 1}).whistle_s));
}

TEST(Opponents, TheFirstOneThereDisputes) {
  Opportunity o;
  o.opponent_count = 2;
  o.opponents[0] = {1.0, 0.0, 0.5};
  o.opponents[1] = {2.0, M_PI, 2.0};
  Opponents opponents;
  opponents.place({0.0, 0.0, 0.11}, o);
  EXPECT_EQ(&opponents.nearest(), &opponents.all()[0]);
  EXPECT_EQ(&opponents.first_at(0.5), &opponents.all()[1]);
  EXPECT_NEAR(opponents.first_at(0.5).time_until_s(0.5), 0.75, 1e-12);
  opponents.close_in({0.0, 0.0, 0.11}, 0.75);
  EXPECT_EQ(&opponents.nearest(), &opponents.all()[1]);
  EXPECT_NEAR(opponents.nearest().position().y_m, -0.5, 1e-12);
}

}  // namespace
}  // namespace trivela::sim
