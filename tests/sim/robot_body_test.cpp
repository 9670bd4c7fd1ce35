#include "sim/robot_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trivela::sim {
namespace {

TEST(RobotBody, ReachesASetPointAsFastAsItsAccelerationLets) {
  RobotBody body{Robot{}};
  body.follow({0.0, 2.0, 0.0});
  for (int i = 0; i < 400; ++i) body.advance(1e-3);
  EXPECT_NEAR(body.twist().vy_mps, 1.0, 1e-9);
  EXPECT_NEAR(body.pose().y_m, 0.2, 1e-9);
  for (int i = 0; i < 1000; ++i) body.advance(1e-3);
  EXPECT_NEAR(body.twist().vy_mps, 2.0, 1e-9);
  EXPECT_NEAR(body.pose().y_m, 0.5 * 2.5 * 0.64 + 2.0 * 0.6, 1e-9);
}

TEST(RobotBody, TurnsAsFastAsItsLimitsLet) {
  RobotBody body{Robot{}};
  body.follow({0.0, 0.0, 100.0});
  for (int i = 0; i < 250; ++i) body.advance(1e-3);
  EXPECT_NEAR(body.twist().omega_radps, 1.0, 1e-9);
  EXPECT_NEAR(body.pose().heading_rad, 0.5 * 4.0 * 0.0625, 1e-9);
  for (int i = 0; i < 1000; ++i) body.advance(1e-3);
  EXPECT_NEAR(body.twist().omega_radps, 2.5, 1e-9);
}

TEST(RobotBody, NeverExceedsItsLimitsWhateverIsAsked) {
  RobotBody body{Robot{}};
  const Robot limits;
  double last_x = 0, last_y = 0;
  for (int i = 0; i < 5000; ++i) {
    const double phase = i * 0.37;
    body.follow({20.0 * std::sin(phase), 20.0 * std::cos(1.7 * phase), 50.0 * std::sin(0.3 * phase)});
    body.advance(1e-3);
    const auto twist = body.twist();
    const double h = body.pose().heading_rad;
    const double vx = std::cos(h) * twist.vx_mps - std::sin(h) * twist.vy_mps;
    const double vy = std::sin(h) * twist.vx_mps + std::cos(h) * twist.vy_mps;
    ASSERT_LE(std::hypot(vx, vy), limits.max_speed_mps + 1e-9);
    ASSERT_LE(std::abs(twist.omega_radps), limits.max_turn_rate_radps + 1e-9);
    ASSERT_LE(std::hypot(vx - last_x, vy - last_y), limits.max_acceleration_mps2 * 1e-3 + 1e-9);
    last_x = vx;
    last_y = vy;
  }
}

TEST(RobotBody, BrakesOnASetPointThatIsNoNumber) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    RobotBody body{Robot{}};
    body.place({1.0, 2.0, 0.5}, {0.3, 1.0, 0.7});
    body.follow({bad, 1.0, 0.7});
    for (int i = 0; i < 1000; ++i) body.advance(1e-3);
    EXPECT_NEAR(body.twist().vx_mps, 0.0, 1e-12);
    EXPECT_NEAR(body.twist().vy_mps, 0.0, 1e-12);
    EXPECT_NEAR(body.twist().omega_radps, 0.0, 1e-12);
  }
}

TEST(RobotBody, HoldsTheBallInFront) {
  RobotBody body{Robot{}};
  body.place({1.0, 2.0, M_PI / 2}, {});
  EXPECT_NEAR(body.ball_point_m().x(), 0.73, 1e-12);
  EXPECT_NEAR(body.ball_point_m().y(), 2.0, 1e-12);
}

}  // namespace
}  // namespace trivela::sim
