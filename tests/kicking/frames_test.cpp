#include "kicking/geometry/frames.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace trivela::kicking {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Frames, HeadingZeroFacesTheOpponentsGoalAndTurnsCounterClockwise) {
  EXPECT_TRUE(direction(0.0).isApprox(Eigen::Vector2d(0, 1)));
  EXPECT_TRUE(direction(kPi / 2).isApprox(Eigen::Vector2d(-1, 0)));
  EXPECT_TRUE(to_field({1, 2, kPi / 2}, {0, 3}).isApprox(Eigen::Vector2d(-2, 2)));
  EXPECT_TRUE(to_field({1, 2, kPi / 2}, {3, 0}).isApprox(Eigen::Vector2d(1, 5)));
}

TEST(Frames, ToRobotUndoesToField) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-10, 10);
  for (int i = 0; i < 1000; ++i) {
    const Pose pose{any(random), any(random), any(random)};
    const Eigen::Vector2d point(any(random), any(random));
    EXPECT_LT((to_robot(pose, to_field(pose, point)) - point).norm(), 1e-12);
  }
}

TEST(Frames, BearingIsTheHeadingThatFacesAPoint) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-10, 10);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d from(any(random), any(random));
    const Eigen::Vector2d to(any(random), any(random));
    EXPECT_LT((direction(bearing(from, to)) - (to - from).normalized()).norm(), 1e-12);
  }
}

TEST(Angle, WrapsToOneTurn) {
  EXPECT_NEAR(wrap_angle(2 * kPi + 0.1), 0.1, 1e-12);
  EXPECT_NEAR(wrap_angle(-7 * kPi / 2), kPi / 2, 1e-12);
  EXPECT_NEAR(std::abs(wrap_angle(kPi)), kPi, 1e-12);
  EXPECT_DOUBLE_EQ(degrees(radians(36.78)), 36.78);
}

TEST(Advance, QuarterCircleEndsWhereGeometrySays) {
  // Forward at 1 m/s, turning at 1 rad/s: a circle of 1 m radius, centre on the left.
  const Pose end = advance({0, 0, 0}, {0, 1, 1}, kPi / 2);
  EXPECT_NEAR(end.x_m, -1.0, 1e-12);
  EXPECT_NEAR(end.y_m, 1.0, 1e-12);
  EXPECT_NEAR(end.heading_rad, kPi / 2, 1e-12);
}

TEST(Advance, IsExactWithoutRotationAndSmoothAroundIt) {
  const Pose straight = advance({1, 2, 0.3}, {0.5, -1.5, 0.0}, 0.4);
  const Eigen::Vector2d expected = to_field({1, 2, 0.3}, {0.2, -0.6});
  EXPECT_DOUBLE_EQ(straight.x_m, expected.x());
  EXPECT_DOUBLE_EQ(straight.y_m, expected.y());
  for (const double omega : {1e-12, 1e-6, 5e-4}) {
    const Pose a = advance({0, 0, 0}, {0.5, 1.5, omega}, 0.4);
    EXPECT_NEAR(a.x_m, 0.2 - 0.5 * omega * 0.4 * 0.6, 1e-8);
    EXPECT_NEAR(a.y_m, 0.6 + 0.5 * omega * 0.4 * 0.2, 1e-8);
  }
  for (const double omega : {0.1, 0.2, 0.2499, 0.2501, 0.3}) {  // either side of the series' limit
    const Pose a = advance({0, 0, 0}, {0.5, 1.5, omega}, 0.4);
    const double sinc = std::sin(0.4 * omega) / omega, versc = (1 - std::cos(0.4 * omega)) / omega;
    EXPECT_NEAR(a.x_m, sinc * 0.5 - versc * 1.5, 1e-14);
    EXPECT_NEAR(a.y_m, versc * 0.5 + sinc * 1.5, 1e-14);
  }
}

TEST(Advance, TwoHalvesAreOneWhole) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-3, 3);
  for (int i = 0; i < 1000; ++i) {
    const Pose start{any(random), any(random), any(random)};
    const Twist twist{any(random), any(random), any(random)};
    const Pose once = advance(start, twist, 0.5);
    const Pose twice = advance(advance(start, twist, 0.2), twist, 0.3);
    EXPECT_NEAR(once.x_m, twice.x_m, 1e-12);
    EXPECT_NEAR(once.y_m, twice.y_m, 1e-12);
    EXPECT_NEAR(once.heading_rad, twice.heading_rad, 1e-12);
  }
}

}  // namespace
}  // namespace trivela::kicking
