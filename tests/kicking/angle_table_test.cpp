// Exit angles apart for each power, in the table and in the shot that is solved with them.
#include "kicking/model/power_table.hpp"

#include <gmock/gmock.h>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/policy/policy_config.hpp"
#include "kicking/policy/shot.hpp"

namespace trivela::kicking {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(AngleTable, IsLinearBetweenSetPointsAndClampsAtItsEnds) {
  const std::vector<AnglePoint> points{{10, 0.8}, {20, 0.6}, {40, 0.7}};
  const AngleTable table{points};
  EXPECT_DOUBLE_EQ(table.angle_for(5), 0.8);
  EXPECT_DOUBLE_EQ(table.angle_for(15), 0.7);
  EXPECT_DOUBLE_EQ(table.angle_for(20), 0.6);
  EXPECT_DOUBLE_EQ(table.angle_for(30), 0.65);
  EXPECT_DOUBLE_EQ(table.angle_for(99), 0.7);
}

TEST(AngleTable, NamesIndexAndValueOfABadPoint) {
  const auto make = [](std::vector<AnglePoint> points) { return [points] { AngleTable table{points}; }; };
  EXPECT_THAT(make({{10, 0.8}}), ThrowsMessage<std::invalid_argument>(HasSubstr("1 set-points, need 2 to 256")));
  EXPECT_THAT(make({{10, 0.8}, {10, 0.7}}), ThrowsMessage<std::invalid_argument>(HasSubstr("power[1] = 10")));
  EXPECT_THAT(make({{10, 0.8}, {20, 1.6}}), ThrowsMessage<std::invalid_argument>(HasSubstr("exit_angle_rad[1] = 1.6")));
}

/// Falcons-like: steep weak kicks, flat strong ones.
RobotModel with_angles() {
  RobotModel robot;
  std::vector<AnglePoint> points;
  for (const SetPoint& point : robot.table.set_points()) {
    points.push_back({point.power, radians(47.0 - 0.3 * (point.power - 15.0))});
  }
  robot.exit_angles.emplace(points);
  return robot;
}

PolicyInput at(double distance_m, const Twist& twist = {}) {
  PolicyInput input;
  input.pose = {0.0, 9.0 - 0.27 - distance_m, 0.0};
  input.twist = twist;
  return input;
}

TEST(ShotWithAngles, PassesTheTargetHeightWithThePowersOwnAngle) {
  const RobotModel robot = with_angles();
  PolicyConfig config;
  config.height_law = HeightLaw::kExact;
  int solved = 0;
  for (double d = 3.0; d <= 8.0; d += 0.1) {
    const Shot shot = stopped_shot(config, robot, {}, at(d), {0.0, Goal{}.y_m});
    ASSERT_TRUE(shot.power) << d;
    if (!shot.reachable || *shot.power <= 15.0) continue;
    ++solved;
    const double angle = robot.exit_angle_at(*shot.power);
    const double v = robot.table.speed_for(*shot.power);
    EXPECT_NEAR(height_at(d, v * std::cos(angle), v * std::sin(angle)), 0.70 - 0.11, 1e-9) << d;
    EXPECT_NEAR(shot.predicted->z_m, 0.70, 1e-9) << d;
    EXPECT_NEAR(shot.exit_angle.angle_rad, angle, 1e-12);
  }
  EXPECT_GT(solved, 40);
}

TEST(ShotWithAngles, OfAMovingRobotPassesItToo) {
  const RobotModel robot = with_angles();
  PolicyConfig config;
  config.height_law = HeightLaw::kExact;
  int solved = 0;
  for (const double vy : {-1.0, 0.5, 1.5}) {
    for (double d = 4.0; d <= 7.0; d += 0.25) {
      const Shot shot = moving_shot(config, robot, {}, at(d, {0.0, vy, 0.0}), {0.0, Goal{}.y_m});
      if (!shot.reachable || *shot.power <= 15.0) continue;
      ++solved;
      EXPECT_NEAR(shot.predicted->z_m, 0.70, 1e-9) << d << " " << vy;
    }
  }
  EXPECT_GT(solved, 30);
}

TEST(ShotWithAngles, OfOneAngleForAllIsTheShotWithout) {
  const RobotModel plain;
  RobotModel same = plain;
  std::vector<AnglePoint> points;
  for (const SetPoint& point : plain.table.set_points()) points.push_back({point.power, plain.exit_angle_rad});
  same.exit_angles.emplace(points);
  for (double d = 2.0; d <= 12.0; d += 0.25) {
    const Shot a = moving_shot({}, plain, {}, at(d, {0.3, 1.0, 0.2}), {0.0, Goal{}.y_m});
    const Shot b = moving_shot({}, same, {}, at(d, {0.3, 1.0, 0.2}), {0.0, Goal{}.y_m});
    EXPECT_EQ(a.power, b.power) << d;
    EXPECT_EQ(a.v_kick_mps, b.v_kick_mps) << d;
    EXPECT_EQ(a.reachable, b.reachable) << d;
    EXPECT_EQ(a.too_far, b.too_far) << d;
  }
}

TEST(ShotWithAngles, BeyondTheStrongestKickIsTooFar) {
  const Shot shot = stopped_shot({}, with_angles(), {}, at(14.0), {0.0, Goal{}.y_m});
  EXPECT_TRUE(shot.too_far);
  EXPECT_FALSE(shot.reachable);
  EXPECT_EQ(shot.power, 50.0);
}

TEST(ShotWithAngles, FlatterThanTheHeightAtEveryPowerHasNoShot) {
  RobotModel robot;
  const std::vector<AnglePoint> flat{{15, radians(6)}, {50, radians(5)}};
  robot.exit_angles.emplace(flat);
  PolicyConfig config;
  config.height_law = HeightLaw::kExact;
  const Shot shot = stopped_shot(config, robot, {}, at(4.0), {0.0, Goal{}.y_m});  // 4 m * tan(6 degrees) = 0.42 m
  EXPECT_FALSE(shot.v_kick_mps);
  EXPECT_FALSE(shot.power);
  EXPECT_FALSE(shot.reachable);
}

}  // namespace
}  // namespace trivela::kicking
