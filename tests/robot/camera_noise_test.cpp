#include "robot/observer/shot_tracker.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace trivela::robot {
namespace {

/// A flight of `n` sightings that something turns in the middle.
std::vector<kicking::Sighting> flight(double sd_m, int n, std::mt19937_64& random) {
  std::normal_distribution<double> noise{0.0, sd_m};
  std::vector<kicking::Sighting> seen;
  for (int i = 0; i < n; ++i) {
    const double t_s = 0.02 * i, turned_s = 0.02 * std::max(0, i - n / 2);
    seen.push_back(
        {i * 20'000'000,
         {1.0 * t_s + 4.0 * turned_s + noise(random), 8.0 * t_s - 9.0 * turned_s + noise(random), noise(random)}});
  }
  return seen;
}

TEST(CameraNoise, IsTheConfiguredOneBeforeAnythingWasSeen) {
  CameraNoise noise{0.05};
  EXPECT_DOUBLE_EQ(noise.sd_m(), 0.05);
  noise.learn({});
  EXPECT_DOUBLE_EQ(noise.sd_m(), 0.05);
}

TEST(CameraNoise, IsFoundWhateverIsConfigured) {
  for (const double sd_m : {0.02, 0.03, 0.15}) {
    std::mt19937_64 random{7};
    CameraNoise noise{0.03};
    for (int i = 0; i < 40; ++i) noise.learn(flight(sd_m, 30, random));
    EXPECT_NEAR(noise.sd_m() / sd_m, 1.0, 0.12) << sd_m;
  }
}

TEST(CameraNoise, OneFlightSaysMostOfIt) {
  std::mt19937_64 random{8};
  CameraNoise noise{0.03};
  noise.learn(flight(0.15, 30, random));
  EXPECT_GT(noise.sd_m(), 0.10);
}

TEST(CameraNoise, MayChange) {
  std::mt19937_64 random{9};
  CameraNoise noise{0.03};
  for (int i = 0; i < 40; ++i) noise.learn(flight(0.03, 30, random));
  for (int i = 0; i < 40; ++i) noise.learn(flight(0.10, 30, random));
  EXPECT_NEAR(noise.sd_m(), 0.10, 0.015);
}

}  // namespace
}  // namespace trivela::robot
