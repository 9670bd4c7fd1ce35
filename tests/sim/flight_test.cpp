#include "sim/kicker/flight.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kicking/ballistics/floor_way.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::sim {
namespace {

constexpr double kStep_s = 1e-3;

BallMotion launch(double speed, double elevation, double z = 0.11) {
  return {{{0.0, 0.0, z}, {0.0, speed * std::cos(elevation), speed * std::sin(elevation)}}};
}

double energy(const BallMotion& m, const BallPhysics& ball) {
  const Eigen::Vector3d& v = m.velocity_mps;
  return 0.5 * (v.x() * v.x() + v.y() * v.y() + v.z() * v.z()) + ball.gravity_mps2 * m.position_m.z();
}

TEST(Flight, WithoutDragFollowsTheParabola) {
  BallPhysics ball;
  ball.drag_coefficient = 0.0;
  BallMotion m = launch(8.0, 0.7, 1.0);
  const Eigen::Vector3d v = m.velocity_mps;
  for (int i = 1; i <= 900; ++i) {
    advance(m, ball, kStep_s);
    const double t = i * kStep_s;
    ASSERT_NEAR(m.position_m.y(), v.y() * t, 1e-9);
    ASSERT_NEAR(m.position_m.z(), 1.0 + v.z() * t - 0.5 * 9.81 * t * t, 1e-9);
  }
}

TEST(Flight, LandsWhereTheDragVectorsSay) {
  for (const auto& row : tests::rows("drag_trajectory.csv")) {
    SCOPED_TRACE(row.where());
    BallPhysics ball;
    ball.drag_coefficient = row.number("Cd");
    EXPECT_NEAR(drag_per_m(ball), row.number("k_per_m"), 1e-6);
    BallMotion m = launch(row.number("v0_mps"), row.number("theta_deg") * M_PI / 180.0, 50.0);
    double apex = 0.0;
    BallMotion before = m;
    double t = 0.0;
    while (m.position_m.z() >= 50.0) {
      before = m;
      advance(m, ball, kStep_s);
      t += kStep_s;
      apex = std::max(apex, m.position_m.z() - 50.0);
    }
    const double part = (before.position_m.z() - 50.0) / (before.position_m.z() - m.position_m.z());
    EXPECT_NEAR(std::lerp(before.position_m.y(), m.position_m.y(), part), row.number("range_m"), 1e-4);
    EXPECT_NEAR(t - kStep_s + part * kStep_s, row.number("time_s"), 1e-4);
    EXPECT_NEAR(apex, row.number("apex_m"), 1e-4);
  }
}

TEST(Flight, ALowBallOnAFloorWithFrictionTakesTheTimeThatThePolicyReckonsWith) {
  for (const double friction : {0.1, 0.3, 0.5})
    for (const double elevation : {0.0, 0.05, 0.1}) {
      BallPhysics ball;
      ball.drag_coefficient = 0.0;
      ball.sliding_friction_ratio = friction;
      BallMotion m = launch(10.0, elevation);
      m.rolling = elevation == 0.0;
      const Eigen::Vector3d v = m.velocity_mps;
      double t = 0.0, before = 0.0;
      for (double distance = 1.0; distance <= 8.0; distance += 1.0) {
        for (; m.position_m.y() < distance; t += kStep_s) advance(m, ball, kStep_s);
        const double reckoned = kicking::floor_time_s(v.y(), v.z(), distance, {.friction_ratio = friction});
        EXPECT_NEAR(t, reckoned, 0.04 * reckoned + kStep_s) << friction << ' ' << elevation << ' ' << distance;
        EXPECT_GT(t, before);
        before = t;
      }
    }
}

TEST(Flight, WithFrictionABallWithoutSpinRollsAtThreeFifthsOfItsSpeed) {
  BallPhysics ball;
  ball.drag_coefficient = 0.0;
  ball.rolling_deceleration_mps2 = 0.0;
  for (const double friction : {0.05, 0.3, 1.0})
    for (const double elevation : {0.0, 0.1, 0.5}) {
      ball.sliding_friction_ratio = friction;
      BallMotion m = launch(5.0, elevation);
      m.rolling = elevation == 0.0;
      for (int i = 0; i < 10000; ++i) advance(m, ball, kStep_s);
      EXPECT_TRUE(m.rolling);
      EXPECT_NEAR(m.velocity_mps.y(), kicking::kRollingShare * 5.0 * std::cos(elevation), 1e-6);
      EXPECT_NEAR(m.rim_mps, m.velocity_mps.y(), 1e-6);
    }
}

TEST(Flight, NeverGainsEnergyAndComesToRest) {
  for (const double elevation : {0.0, 0.1, 0.64, 1.2, 1.57}) {
    const BallPhysics ball;
    BallMotion m = launch(9.0, elevation);
    double last = energy(m, ball) + 1e-9;
    int steps = 0;
    for (; !at_rest(m) && steps < 60000; ++steps) {
      advance(m, ball, kStep_s);
      ASSERT_LE(energy(m, ball), last + 1e-9);
      ASSERT_GE(m.position_m.z(), ball.radius_m - 1e-9);
      last = energy(m, ball);
    }
    EXPECT_TRUE(at_rest(m));
    const Eigen::Vector3d resting = m.position_m;
    advance(m, ball, 0.1);
    EXPECT_EQ(m.position_m.y(), resting.y());
  }
}

TEST(Flight, BouncesWithRestitutionAndRetention) {
  BallPhysics ball;
  ball.drag_coefficient = 0.0;
  BallMotion m{{{0.0, 0.0, 0.61}, {1.0, 2.0, 0.0}}};
  const double impact = std::sqrt(2.0 * 9.81 * 0.5), fall = impact / 9.81;
  const double t = 0.4;  // after the first bounce, before the second
  for (int i = 0; i < 400; ++i) advance(m, ball, kStep_s);
  const double flown = t - fall;
  EXPECT_NEAR(m.velocity_mps.z(), 0.65 * impact - 9.81 * flown, 1e-6);
  EXPECT_NEAR(m.position_m.z(), 0.11 + 0.65 * impact * flown - 0.5 * 9.81 * flown * flown, 1e-6);
  EXPECT_NEAR(m.velocity_mps.x(), 0.8, 1e-12);
  EXPECT_NEAR(m.position_m.y(), 2.0 * fall + 1.6 * flown, 1e-6);
}

TEST(Flight, RollsAsFarAsItsDecelerationLets) {
  BallPhysics ball;
  ball.drag_coefficient = 0.0;
  BallMotion m{{{0.0, 0.0, ball.radius_m}, {0.6, 0.8, 0.0}}, true};
  while (!at_rest(m)) advance(m, ball, kStep_s);
  EXPECT_NEAR(std::hypot(m.position_m.x(), m.position_m.y()), 1.0 / (2.0 * ball.rolling_deceleration_mps2), 1e-9);
  EXPECT_NEAR(m.position_m.x() / m.position_m.y(), 0.75, 1e-9);
}

TEST(Flight, IsItsOwnMirrorImage) {
  const BallPhysics ball;
  BallMotion right{{{0.5, 0.0, 0.11}, {1.3, 5.0, 4.0}}}, left{{{-0.5, 0.0, 0.11}, {-1.3, 5.0, 4.0}}};
  for (int i = 0; i < 2500; ++i) {
    advance(right, ball, kStep_s);
    advance(left, ball, kStep_s);
  }
  EXPECT_EQ(right.position_m.x(), -left.position_m.x());
  EXPECT_EQ(right.position_m.y(), left.position_m.y());
  EXPECT_EQ(right.position_m.z(), left.position_m.z());
}

TEST(Flight, DoesNotDependOnTheStep) {
  const BallPhysics ball;
  BallMotion coarse = launch(8.0, 0.64), fine = coarse;
  for (int i = 0; i < 2000; ++i) advance(coarse, ball, 1e-3);
  for (int i = 0; i < 20000; ++i) advance(fine, ball, 1e-4);
  EXPECT_NEAR(coarse.position_m.y(), fine.position_m.y(), 1e-5);
  EXPECT_NEAR(coarse.position_m.z(), fine.position_m.z(), 1e-5);
}

}  // namespace
}  // namespace trivela::sim
