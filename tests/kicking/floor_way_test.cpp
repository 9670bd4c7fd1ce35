// A ball that is kicked low: over the floor, and as the policy predicts it.
#include "kicking/ballistics/floor_way.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kicking/geometry/goal.hpp"
#include "kicking/policy/predictive/shot_chance.hpp"

namespace trivela::kicking {
namespace {

TEST(FloorWay, InTheAirIsDistanceOverSpeed) { EXPECT_DOUBLE_EQ(floor_time_s(10.0, 1.0, 2.0), 0.2); }

TEST(FloorWay, AHandCaseFliesTouchesSlidesAndRolls) {
  // g 10: flies 0.2 s and 2 m; loses 0.5 * 2 * 1 = 1; slides with 5 from 9 to 6 over 4.5 m in 0.6 s; rolls with 1.
  const Floor floor{.friction_ratio = 0.5, .restitution_ratio = 1.0, .rolling_deceleration_mps2 = 1.0};
  EXPECT_DOUBLE_EQ(floor_time_s(10.0, 1.0, 2.0, floor, 10.0), 0.2);
  EXPECT_NEAR(floor_time_s(10.0, 1.0, 6.5, floor, 10.0), 0.8, 1e-12);
  const double rolled_s = 6.0 - std::sqrt(36.0 - 2.0 * 5.5);  // 5.5 m further
  EXPECT_NEAR(floor_time_s(10.0, 1.0, 12.0, floor, 10.0), 0.8 + rolled_s, 1e-12);
  EXPECT_NEAR(floor_time_s(10.0, 1.0, 6.5 + 18.0, floor, 10.0), 6.8, 1e-6) << "it rests there";
  EXPECT_EQ(floor_time_s(10.0, 1.0, 6.5 + 18.1, floor, 10.0), HUGE_VAL);
}

TEST(FloorWay, TakesLongerTheFartherAndTheRougherTheFloor) {
  for (double v = 2.0; v <= 12.0; v += 1.0) {
    double before = 0.0;
    for (double distance = 0.5; distance <= 9.0; distance += 0.5) {
      double smooth = 0.0;
      for (const double friction : {0.0, 0.1, 0.3, 0.6, 1.5}) {
        const double t = floor_time_s(v, 0.1 * v, distance, {.friction_ratio = friction});
        EXPECT_GE(t, smooth);
        EXPECT_GE(t, distance / v - 1e-12);
        smooth = t;
        if (friction != 0.3) continue;
        EXPECT_TRUE(t > before || t == HUGE_VAL);
        before = t;
      }
    }
  }
}

TEST(FloorWay, OfABallThatDoesNotMoveIsWithoutEnd) {
  EXPECT_EQ(floor_time_s(0.0, 1.0, 2.0), HUGE_VAL);
  EXPECT_EQ(floor_time_s(std::nan(""), 1.0, 2.0), HUGE_VAL);
}

RobotModel flat_robot(double angle_deg) {
  RobotModel robot;
  robot.exit_angle_rad = radians(angle_deg);
  return robot;
}

TEST(LowKick, IsOneThatStaysUnderTheBarAtFullPower) {
  EXPECT_TRUE(low_kick(flat_robot(0.0), {}));
  EXPECT_TRUE(low_kick(flat_robot(14.0), {}));
  EXPECT_FALSE(low_kick(flat_robot(30.0), {}));
  EXPECT_FALSE(low_kick({}, {}));
}

TEST(LowKick, HasFullPowerAndTheTimeOfItsWayOverTheFloor) {
  const PolicyConfig config;
  const RobotModel robot = flat_robot(6.0);
  const Goal goal;
  const ShotModel model{config, robot, goal, {}};
  for (double distance = 1.0; distance <= 8.0; distance += 0.5) {
    ShotGuess guess{.exit_angle = Elevation(robot.exit_angle_rad)};
    const ShotChance shot = model.chance({.ball_m{0.0, goal.y_m - distance}}, guess);
    const double v = robot.table.back().speed_mps;
    EXPECT_EQ(shot.power, robot.table.back().power);
    EXPECT_NEAR(shot.crossing.x_m, 0.0, 1e-12);
    EXPECT_NEAR(shot.crossing.t_flight_s,
                floor_time_s(v * std::cos(robot.exit_angle_rad), v * std::sin(robot.exit_angle_rad), distance), 1e-9);
    EXPECT_GT(shot.p, 0.5) << distance;
  }
}

TEST(LowKick, ThatStopsBeforeTheLineIsOutOfRange) {
  const PolicyConfig config;
  RobotModel robot = flat_robot(2.0);
  robot.table = EffectiveTable{{10, 0.5}, {20, 1.0}};
  const Goal goal;
  const ShotModel model{config, robot, goal, {}};
  ShotGuess guess{.exit_angle = Elevation(robot.exit_angle_rad)};
  const ShotChance shot = model.chance({.ball_m{0.0, goal.y_m - 5.0}}, guess);
  EXPECT_TRUE(shot.out_of_range);
  EXPECT_EQ(shot.p, 0.0);
}

}  // namespace
}  // namespace trivela::kicking
