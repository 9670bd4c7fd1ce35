#include "kicking/fit/scatter_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace trivela::kicking {
namespace {

TEST(DirectionFit, TakesTheObserversNoiseOut) {
  // By hand: -1, 0, 1 have s = 1; of it the track explains 0.6.
  const std::vector<LaunchDirection> kicks{{-0.1, 0.06}, {0.0, 0.06}, {0.1, 0.06}};
  const DirectionFit fit = fit_direction(kicks);
  EXPECT_NEAR(fit.seen_sd_rad, 0.1, 1e-12);
  EXPECT_NEAR(fit.observer_sd_rad, 0.06, 1e-12);
  EXPECT_NEAR(fit.sd_rad.value, 0.08, 1e-12);
  EXPECT_NEAR(fit.mean_rad, 0.0, 1e-12);
}

TEST(DirectionFit, IsUnknownWhereTheTrackExplainsAll) {
  const std::vector<LaunchDirection> kicks{{-0.01, 0.05}, {0.0, 0.05}, {0.01, 0.05}};
  EXPECT_TRUE(std::isnan(fit_direction(kicks).sd_rad.value)) << "unknown, not 0";
}

TEST(DirectionFit, FindsTheScatterWithinItsStandardErrorOverManySamples) {
  std::mt19937 engine(7);
  std::normal_distribution<double> kicker(0.2, 0.026), camera(0.0, 0.01);
  int within = 0;
  for (int sample = 0; sample < 200; ++sample) {
    std::vector<LaunchDirection> kicks;
    for (int i = 0; i < 60; ++i) kicks.push_back({kicker(engine) + camera(engine), 0.01});
    const DirectionFit fit = fit_direction(kicks);
    if (std::abs(fit.sd_rad.value - 0.026) < 1.96 * fit.sd_rad.se) ++within;
  }
  EXPECT_GE(within, 180);
}

TEST(DirectionFit, RefusesWhatSaysNothing) {
  EXPECT_THROW(fit_direction({}), std::invalid_argument);
  const std::vector<LaunchDirection> one{{0.1, 0.0}}, broken{{0.1, 0.0}, {NAN, 0.0}};
  EXPECT_THROW(fit_direction(one), std::invalid_argument);
  EXPECT_THROW(fit_direction(broken), std::invalid_argument);
}

}  // namespace
}  // namespace trivela::kicking
