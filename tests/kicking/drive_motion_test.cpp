#include "kicking/policy/predictive/drive_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trivela::kicking {
namespace {

const PolicyConfig kConfig;

TEST(DriveMotion, AtAnUnchangedVelocityGoesStraightAndTurnsEvenly) {
  DriveMotion motion({1.0, 2.0, 0.3}, {0.0, 0.0, 1.5});
  for (int i = 0; i < 50; ++i) motion.step({0.0, 0.0, 1.5}, kConfig, 0.02);
  EXPECT_NEAR(motion.heading_rad, 1.8, 1e-9);
  EXPECT_NEAR(motion.forward.x(), -std::sin(1.8), 1e-9);
  EXPECT_NEAR(motion.forward.y(), std::cos(1.8), 1e-9);
  EXPECT_NEAR(motion.position_m.x(), 1.0, 1e-12);
}

TEST(DriveMotion, ChangesNoFasterThanTheBase) {
  DriveMotion motion({0, 0, 0}, {0.0, 2.0, 0.0});
  motion.step({0.0, 0.0, 2.5}, kConfig, 0.1);
  EXPECT_NEAR(motion.velocity_mps.norm(), 2.0 - 0.1 * kConfig.max_brake_mps2, 1e-9);
  EXPECT_NEAR(motion.omega_radps, 0.1 * kConfig.max_turn_acceleration_radps2, 1e-9);
  EXPECT_NEAR(motion.position_m.y(), 0.1 * (2.0 - 0.05 * kConfig.max_brake_mps2), 1e-9);
}

TEST(DriveMotion, GivesBackItsTwist) {
  const Twist twist{0.4, 1.1, -0.7};
  const Twist back = DriveMotion({1, 2, 2.2}, twist).twist();
  EXPECT_NEAR(back.vx_mps, twist.vx_mps, 1e-12);
  EXPECT_NEAR(back.vy_mps, twist.vy_mps, 1e-12);
  EXPECT_EQ(back.omega_radps, twist.omega_radps);
}

TEST(DrivePlan, ThroughTurnsAtFullRateWhereOntoBrakes) {
  const DriveMotion near({0, 3, 0.2}, {});
  EXPECT_EQ(command_of(DrivePlan::kThrough, near, kConfig, {0, 9}, kConfig.dribble_mps, 1.0, 6.0).omega_radps,
            -kConfig.max_turn_rate_radps);
  const double onto = command_of(DrivePlan::kOnto, near, kConfig, {0, 9}, kConfig.dribble_mps, 1.0, 6.0).omega_radps;
  EXPECT_LT(onto, 0.0);
  EXPECT_GT(onto, -kConfig.max_turn_rate_radps);
}

TEST(DrivePlan, KeepsTurningTheLongWayWhenTurningBackTakesLonger) {
  const DriveMotion past({0, 3, 3.3}, {0, 0, 2.5});  // turns left, the target is a little nearer on the right
  for (const DrivePlan plan : kDrivePlans) {
    EXPECT_GT(command_of(plan, past, kConfig, {0, 9}, kConfig.dribble_mps, 1.0, 6.0).omega_radps, 0.0);
    EXPECT_GT(command_of(plan, DriveMotion({0, 3, 2.9}, {0, 0, 2.5}), kConfig, {0, 9}, kConfig.dribble_mps, 1.0, 6.0)
                  .omega_radps,
              0.0);
    EXPECT_LT(
        command_of(plan, DriveMotion({0, 3, 2.9}, {}), kConfig, {0, 9}, kConfig.dribble_mps, 1.0, 6.0).omega_radps,
        0.0);
  }
}

}  // namespace
}  // namespace trivela::kicking
