#include "robot/belief/pose_filter.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace trivela::robot {
namespace {

using kicking::Pose;
using kicking::TurnedPose;

void expect_near(const Pose& a, const Pose& b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x_m, b.x_m, tolerance);
  EXPECT_NEAR(a.y_m, b.y_m, tolerance);
  EXPECT_NEAR(kicking::wrap_angle(a.heading_rad - b.heading_rad), 0.0, tolerance);
}

TEST(RelativePose, IsSeenFromTheFirstByHand) {
  // Facing +x of F (heading -90 degrees), what lies 2 m towards +x lies 2 m ahead.
  const Pose from{1.0, 1.0, -std::numbers::pi / 2};
  expect_near(relative(TurnedPose{from}, {3.0, 1.0, 0.0}), {0.0, 2.0, std::numbers::pi / 2});
  expect_near(compose(TurnedPose{from}, {0.0, 2.0, std::numbers::pi / 2}), {3.0, 1.0, 0.0});
}

TEST(RelativePose, ComposeUndoesRelative) {
  std::mt19937_64 random{3};
  std::uniform_real_distribution<double> place{-9.0, 9.0};
  std::uniform_real_distribution<double> heading{-7.0, 7.0};
  const auto any = [&] { return Pose{place(random), place(random), heading(random)}; };
  for (int i = 0; i < 500; ++i) {
    const Pose a = any(), b = any(), step = any();
    expect_near(compose(TurnedPose{a}, relative(TurnedPose{a}, b)), b);
    expect_near(relative(TurnedPose{a}, compose(TurnedPose{a}, step)), step);
    EXPECT_LE(std::abs(compose(TurnedPose{a}, step).heading_rad), std::numbers::pi + 1e-12);
  }
}

TEST(PoseHistory, InterpolatesBetweenNeighbours) {
  PoseHistory history{1.0};
  EXPECT_TRUE(history.empty());
  EXPECT_FALSE(history.at(0));
  history.add(100, {0.0, 0.0, 0.0});
  history.add(200, {1.0, 2.0, 0.4});
  expect_near(*history.at(100), {0.0, 0.0, 0.0});
  expect_near(*history.at(125), {0.25, 0.5, 0.1});
  expect_near(*history.at(200), {1.0, 2.0, 0.4});
  expect_near(history.latest(), {1.0, 2.0, 0.4});
}

TEST(PoseHistory, TurnsTheShortWayOverTheSeamOfAngles) {
  PoseHistory history{1.0};
  history.add(0, {0.0, 0.0, 3.1});
  history.add(100, {0.0, 0.0, -3.1});
  EXPECT_NEAR(std::abs(history.at(50)->heading_rad), std::numbers::pi, 1e-12);
}

TEST(PoseHistory, OutsideItsSpanItGivesTheNearestEntry) {
  PoseHistory history{1.0};
  history.add(0, {0.0, 0.0, 0.0});
  history.add(1'000'000'000, {1.0, 0.0, 0.0});
  history.add(2'000'000'000, {2.0, 0.0, 0.0});  // the first one is forgotten
  EXPECT_EQ(history.at(0)->x_m, 1.0);
  EXPECT_EQ(history.at(5'000'000'000)->x_m, 2.0);
}

TEST(PoseHistory, AClockThatGoesBackStartsAnew) {
  PoseHistory history{1.0};
  history.add(500, {5.0, 0.0, 0.0});
  history.add(100, {1.0, 0.0, 0.0});
  EXPECT_EQ(history.at(500)->x_m, 1.0);
  history.add(100, {2.0, 0.0, 0.0});
  EXPECT_EQ(history.at(100)->x_m, 2.0);
}

}  // namespace
}  // namespace trivela::robot
