// What policies are told of the default world, as docs/policies.md says.
#include <gtest/gtest.h>

#include <cmath>

#include "config/settings.hpp"
#include "sim/scenario.hpp"

namespace trivela::config {
namespace {

TEST(Told, TheRobotsLimitsAreTheWorlds) {
  const kicking::PolicyConfig policy = Settings{}.policy;
  const sim::Robot robot;
  EXPECT_EQ(policy.max_forward_mps, robot.max_speed_mps);
  EXPECT_EQ(policy.max_brake_mps2, robot.max_acceleration_mps2);
  EXPECT_EQ(policy.max_turn_rate_radps, robot.max_turn_rate_radps);
  EXPECT_EQ(policy.max_turn_acceleration_radps2, robot.max_turn_acceleration_radps2);
}

TEST(Told, WhatItSeesAndWhoComesAreNearTheWorlds) {
  const auto told = Settings{}.policy.predictive;
  const sim::Vision vision;
  const sim::Opponent opponent;
  EXPECT_NEAR(told.position_sd_m, std::hypot(vision.position_white_sd_m, vision.position_slow_sd_m), 0.002);
  EXPECT_NEAR(told.heading_sd_rad, std::hypot(vision.heading_white_sd_rad, vision.heading_slow_sd_rad), 0.001);
  EXPECT_NEAR(told.opponent_sd_m, vision.opponent_sd_m, 0.011);
  EXPECT_EQ(told.opponent_lag_s, vision.latency_s);
  EXPECT_EQ(told.opponent_radius_m, opponent.body_radius_m);
  EXPECT_EQ(told.opponent_height_m, opponent.body_height_m);
  EXPECT_EQ(told.dispute_distance_m, opponent.dispute_distance_m);
  EXPECT_NEAR(told.closing_mps, 0.5 * (opponent.closing_min_mps + opponent.closing_max_mps), 0.11);
  EXPECT_NEAR(told.closing_sd_mps, (opponent.closing_max_mps - opponent.closing_min_mps) / std::sqrt(12.0), 0.16);
}

TEST(Told, TheKeeperIsTheWorldsWithHalfOfItsFrame) {
  const kicking::KeeperConfig told = Settings{}.policy.keeper;
  const sim::Keeper keeper;
  EXPECT_EQ(told.reaction_s, keeper.guard.reaction_s);
  EXPECT_EQ(told.speed_mps, keeper.guard.speed_mps);
  EXPECT_EQ(told.acceleration_mps2, keeper.guard.acceleration_mps2);
  EXPECT_NEAR(told.half_width_m, keeper.guard.half_width_m + 0.5 * keeper.side_extension_m, 1e-9);
  EXPECT_NEAR(told.height_m, keeper.guard.height_m + 0.5 * keeper.up_extension_m, 1e-9);
}

}  // namespace
}  // namespace trivela::config
