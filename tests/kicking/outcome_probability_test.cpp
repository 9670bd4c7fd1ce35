#include "kicking/outcome/outcome.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace trivela::kicking {
namespace {

double of(const OutcomeProbabilities& p, Outcome outcome) { return p[static_cast<std::size_t>(outcome)]; }

TEST(CrossingProbabilities, AreThoseOfClassifiedDraws) {
  const Goal goal;
  std::mt19937_64 random{5};
  std::normal_distribution<double> normal;
  constexpr int kDraws = 200'000;
  for (const auto& [x_m, z_m] : {std::pair{0.85, 0.85}, std::pair{-1.2, 1.2}, std::pair{0.0, 1.1}}) {
    const auto p = crossing_probabilities(x_m, 0.15, z_m, 0.2, goal);
    OutcomeProbabilities drawn{};
    for (int i = 0; i < kDraws; ++i)
      drawn[static_cast<std::size_t>(classify(x_m + 0.15 * normal(random), z_m + 0.2 * normal(random), goal))] +=
          1.0 / kDraws;
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(p[i], drawn[i], 0.005) << i;
    EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1.0, 1e-12);
  }
}

TEST(CrossingProbabilities, ACertainCrossingHasOneOutcome) {
  const Goal goal;
  for (const double x_m : {-2.0, -1.0, 0.0, 0.95, 1.3}) {
    for (const double z_m : {0.11, 0.88, 1.0, 1.3})
      EXPECT_EQ(of(crossing_probabilities(x_m, 0.0, z_m, 0.0, goal), classify(x_m, z_m, goal)), 1.0) << x_m << z_m;
  }
}

}  // namespace
}  // namespace trivela::kicking
