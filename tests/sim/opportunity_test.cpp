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
    const Opportunity o = draw_opportunity(s, Draws{1, i});
    const double h = o.start.heading_rad;
    const double ball_x = o.start.x_m - 0.27 * std::sin(h), ball_y = o.start.y_m + 0.27 * std::cos(h);
    ASSERT_LE(std::abs(ball_x), 3.0);
    ASSERT_GE(9.0 - ball_y, 3.0 - 1e-9);
    ASSERT_LE(9.0 - ball_y, 9.0 + 1e-9);
    distance += 9.0 - ball_y;
    const double speed = std::hypot(o.velocity.vx_mps, o.velocity.vy_mps);
    ASSERT_GE(speed, 0.3);
    ASSERT_LE(speed, 2.0);
    ASSERT_GE(o.opponent_closing_mps, 0.8);
    ASSERT_LE(o.opponent_closing_mps, 2.0);
    const double error = kicking::wrap_angle(h - std::atan2(ball_x, 9.0 - ball_y));
    aim += error;
    aim2 += error * error;
    bearing += o.opponent_bearing_rad;
    opponents.push_back(o.opponent_distance_m);
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
    const auto start = draw_opportunity(s, Draws{1, i}).start;
    const double reach = (9.0 - start.y_m) / std::cos(start.heading_rad);
    EXPECT_NEAR(start.x_m - std::sin(start.heading_rad) * reach, 0.0, 1e-9);
  }
}

TEST(OpponentBody, ClosesInOnAMovingBallAndStopsAtIt) {
  OpponentBody body;
  body.place({1.0, 2.0, 0.11}, 2.0, -M_PI / 2, 1.5);
  EXPECT_NEAR(body.position().x_m, 3.0, 1e-12);
  EXPECT_NEAR(body.position().y_m, 2.0, 1e-12);
  body.close_in({1.0, 3.0, 0.11}, 1.0);
  EXPECT_NEAR(body.distance_m(), 0.5, 1e-12);
  EXPECT_NEAR(body.position().x_m, 1.5, 1e-12);
  EXPECT_NEAR(body.position().y_m, 3.0, 1e-12);
  body.close_in({1.0, 3.0, 0.11}, 1.0);
  EXPECT_EQ(body.distance_m(), 0.0);
}

}  // namespace
}  // namespace trivela::sim
