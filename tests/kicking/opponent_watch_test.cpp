#include "kicking/policy/predictive/opponent_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace trivela::kicking {
namespace {

constexpr std::int64_t kCycle_ns = 20'000'000;

/// Stands a second at `start_m`, then comes for `coming_s`; seen with the configured noise and age.
OpponentWatch watched(const PredictiveConfig& config, double start_m, double closing_mps, double coming_s,
                      unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, config.opponent_sd_m);
  OpponentWatch watch;
  std::int64_t t_ns = 0;
  for (int i = 0; i < 50; ++i) watch.update(config, t_ns += kCycle_ns, false, start_m + noise(generator), {});
  for (double t = 0.02; t <= coming_s; t += 0.02) {
    const double age_s = std::min(t, config.opponent_lag_s);
    const double seen_m = std::max(0.0, start_m - closing_mps * (t - age_s) + noise(generator));
    watch.update(config, t_ns += kCycle_ns, true, seen_m, {});
  }
  return watch;
}

TEST(OpponentWatch, FindsDistanceAndClosingRate) {
  const PredictiveConfig config;
  double distance_error = 0.0, closing_error = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const OpponentWatch watch = watched(config, 3.0, 1.8, 1.0, seed);
    distance_error += watch.distance_m - 1.2;
    closing_error += watch.closing_mps - 1.8;
    EXPECT_NEAR(watch.distance_m, 1.2, 0.3);
  }
  EXPECT_NEAR(distance_error / 20, 0.0, 0.05);
  EXPECT_NEAR(closing_error / 20, 0.0, 0.2);
}

TEST(OpponentWatch, TakesWhatIsKnownExactlyAsItIs) {
  OpponentWatch watch;
  watch.update({}, 0, true, 2.0, 1.5);
  EXPECT_EQ(watch.distance_m, 2.0);
  EXPECT_EQ(watch.closing_mps, 1.5);
  const PredictiveConfig config;
  const Survival survival(config, watch);
  EXPECT_NEAR(survival(0.99), std::exp(-config.hazard_per_s * 0.99), 1e-12);
  EXPECT_EQ(survival(1.01), 0.0);
}

TEST(OpponentWatch, WithoutObservationsItKnowsLessAndLess) {
  const PredictiveConfig config;
  OpponentWatch watch = watched(config, 3.0, 1.0, 0.5, 3);
  const double before = watch.var_distance_m2;
  for (int i = 1; i <= 20; ++i) watch.update(config, watch.t_ns + kCycle_ns, true, std::nullopt, {});
  EXPECT_GT(watch.var_distance_m2, before);
  EXPECT_LT(watch.distance_m, 2.5);
}

TEST(OpponentWatch, IgnoresWhatIsNoDistance) {
  const PredictiveConfig config;
  OpponentWatch watch;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0})
    watch.update(config, 0, true, bad, {});
  EXPECT_FALSE(watch.seen);
  EXPECT_LT(Survival(config, watch)(1.0), 1.0);
  EXPECT_GT(Survival(config, watch)(1.0), 0.8);
}

TEST(Survival, StartsAtOneAndFalls) {
  const PredictiveConfig config;
  for (const double start : {0.6, 1.0, 2.0, 4.0}) {
    const OpponentWatch watch = watched(config, start, 1.2, 0.1, 5);
    const Survival survival(config, watch);
    EXPECT_EQ(survival(0.0), 1.0);
    double before = 1.0;
    for (double t = 0.05; t < 2.0; t += 0.05) {
      EXPECT_LE(survival(t), before + 1e-6) << start << ' ' << t;
      before = survival(t);
    }
  }
}

}  // namespace
}  // namespace trivela::kicking
