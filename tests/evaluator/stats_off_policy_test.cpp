#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "evaluator/stats/logistic_ridge.hpp"
#include "evaluator/stats/off_policy.hpp"
#include "tests/evaluator/random_numbers.hpp"

namespace trivela::evaluator::stats {
namespace {

TEST(LogisticRidge, FindsTheCurveThatMadeTheResults) {
  RandomNumbers random(7);
  Eigen::MatrixXd x(20000, 2);
  Eigen::VectorXd y(20000);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    x(i, 0) = 3.0 + 2.0 * random.normal();
    x(i, 1) = 100.0 * random.uniform();
    y[i] = random.happens(1.0 / (1.0 + std::exp(-(1.0 - 0.8 * x(i, 0) + 0.02 * x(i, 1))))) ? 1.0 : 0.0;
  }
  const LogisticFit fit = logistic_ridge(x, y, 1.0);
  EXPECT_NEAR(fit.weights[0] / fit.scales[0], -0.8, 0.05);
  EXPECT_NEAR(fit.weights[1] / fit.scales[1], 0.02, 0.002);
  EXPECT_NEAR(fit.probability(Eigen::Vector2d(3.0, 50.0)), 1.0 / (1.0 + std::exp(0.4)), 0.02);
}

TEST(LogisticRidge, StaysFiniteWhereResultsAreSeparatedConstantOrMissing) {
  Eigen::MatrixXd x(6, 2);
  x << 1, 5, 2, 5, 3, 5, 4, 5, 5, 5, 6, 5;  // the second column is constant
  Eigen::VectorXd separated(6), all(6);
  separated << 0, 0, 0, 1, 1, 1;
  all.setOnes();
  const LogisticFit apart = logistic_ridge(x, separated, 1.0);
  EXPECT_GT(apart.probability(Eigen::Vector2d(6.0, 5.0)), 0.7);
  EXPECT_TRUE(apart.weights.allFinite());
  EXPECT_EQ(apart.weights[1], 0.0);
  EXPECT_NEAR(logistic_ridge(x, all, 1.0).probability(Eigen::Vector2d(1.0, 5.0)), 6.5 / 7.0, 1e-12);
  EXPECT_EQ(logistic_ridge(Eigen::MatrixXd(0, 2), Eigen::VectorXd(0), 1.0).probability(Eigen::Vector2d(1.0, 5.0)), 0.5);
}

TEST(OffPolicy, OfAHandCase) {
  // The target was drawn with 1/2 twice and with 1/4 once.
  const std::vector<Trial> trials = {{true, 0.5, 1.0, 0, {}},
                                     {true, 0.5, 0.0, 1, {}},
                                     {true, 0.25, 1.0, 2, {}},
                                     {false, 0.5, 1.0, 0, {}},
                                     {false, 0.75, 0.0, 1, {}}};
  const OffPolicy result = off_policy_value(trials);
  EXPECT_NEAR(result.ips.value, (2.0 + 4.0) / 5.0, 1e-12);
  EXPECT_NEAR(result.snips.value, 6.0 / 8.0, 1e-12);
  EXPECT_NEAR(result.effective_sample_size, 64.0 / 24.0, 1e-12);
  EXPECT_EQ(result.largest_weight, 4.0);
  EXPECT_NEAR(result.logged, 0.6, 1e-12);
  EXPECT_EQ(result.by_target, 3U);
  EXPECT_FALSE(result.by_match) << "three matches are too few";
}

TEST(OffPolicy, OfAPolicyDrawnForEveryTrialIsItsMean) {
  RandomNumbers random(3);
  std::vector<Trial> trials;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < 300; ++i) {
    trials.push_back({true, 1.0, random.happens(0.7) ? 1.0 : 0.0, i % 10, {random.normal(), 0.0, 0.0, 0.0}});
    sum += trials.back().reward;
  }
  const OffPolicy result = off_policy_value(trials);
  for (const PolicyValue& value : {result.ips, result.snips, result.doubly_robust}) {
    EXPECT_NEAR(value.value, sum / 300.0, 1e-12);
  }
  EXPECT_NEAR(result.effective_sample_size, 300.0, 1e-9);
  EXPECT_TRUE(result.by_match);
}

TEST(OffPolicy, HasNoEffectiveTrialWhereThePolicyWasNeverDrawn) {
  const std::vector<Trial> trials = {{false, 0.5, 1.0, 0, {}}};
  EXPECT_EQ(effective_sample_size(trials), 0.0);
}

}  // namespace
}  // namespace trivela::evaluator::stats
