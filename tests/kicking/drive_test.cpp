#include "kicking/policy/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trivela::kicking {
namespace {

TEST(TurnRate, HasTheErrorsSignAndStaysWithinTheLimits) {
  const PolicyConfig config;
  EXPECT_EQ(turn_rate_for(0.0, 6.0, config), 0.0);
  for (double error = 0.001; error < 3.14; error += 0.01) {
    const double rate = turn_rate_for(error, 6.0, config);
    EXPECT_GT(rate, 0.0);
    EXPECT_LE(rate, config.max_turn_rate_radps);
    EXPECT_LE(rate * rate, 2.0 * config.max_turn_acceleration_radps2 * error);  // it can still brake
    EXPECT_EQ(turn_rate_for(-error, 6.0, config), -rate);
  }
}

TEST(Dribble, GoesToThePointAndStopsShortOfIt) {
  const PolicyConfig config;
  const Eigen::Vector2d ahead = dribble_towards({0, 0, 0}, {0, 9}, config, config.dribble_mps);
  EXPECT_DOUBLE_EQ(ahead.x(), 0.0);
  EXPECT_DOUBLE_EQ(ahead.y(), config.dribble_mps);
  EXPECT_EQ(dribble_towards({0, 9 - config.keep_off_m, 0}, {0, 9}, config, config.dribble_mps).norm(), 0.0);
  const double near = dribble_towards({0, 9 - config.keep_off_m - 0.05, 0}, {0, 9}, config, config.dribble_mps).y();
  EXPECT_NEAR(near, std::sqrt(2 * config.max_brake_mps2 * 0.05), 1e-9);
}

TEST(Dribble, HoldsTheBallSidewaysAndBackwards) {
  const PolicyConfig config;
  EXPECT_DOUBLE_EQ(dribble_towards({0, 0, M_PI / 2}, {0, 9}, config, config.dribble_mps).x(), config.max_sideways_mps);
  EXPECT_DOUBLE_EQ(dribble_towards({0, 0, M_PI}, {0, 9}, config, config.dribble_mps).y(), -config.max_sideways_mps);
}

}  // namespace
}  // namespace trivela::kicking
