#include "evaluator/stats/bayes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/evaluator/count_sweep.hpp"

namespace trivela::evaluator::stats {
namespace {

// The finite sum over B(a1 + i, b1 + b2) / ((b2 + i) B(1 + i, b2) B(a1, b1)) for whole parameters.
double by_finite_sum(Counts older, Counts newer) {
  const auto log_beta = [](double a, double b) { return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b); };
  const double a1 = static_cast<double>(older.inside) + 1.0;
  const double b1 = static_cast<double>(older.n - older.inside) + 1.0;
  const double b2 = static_cast<double>(newer.n - newer.inside) + 1.0;
  double sum = 0.0;
  for (std::int64_t k = 0; k <= newer.inside; ++k) {
    const double i = static_cast<double>(k);
    sum += std::exp(log_beta(a1 + i, b1 + b2) - std::log(b2 + i) - log_beta(1.0 + i, b2) - log_beta(a1, b1));
  }
  return sum;
}

TEST(ProbabilityNewBetter, OfTheTable2IsThatOfR) {
  EXPECT_NEAR(p_new_better({34, 65}, {100, 132}), 0.9994725290, 1e-10);
}

TEST(ProbabilityNewBetter, EqualsTheFiniteSumAndMirrors) {
  for (const auto& [older, newer] : {std::pair{Counts{0, 0}, Counts{1, 1}}, std::pair{Counts{0, 3}, Counts{2, 2}},
                                     std::pair{Counts{2, 7}, Counts{5, 9}}, std::pair{Counts{40, 41}, Counts{3, 9}}}) {
    const double p = p_new_better(older, newer);
    EXPECT_NEAR(p, by_finite_sum(older, newer), 1e-10);
    EXPECT_NEAR(p, 1.0 - p_new_better(newer, older), 1e-10);
    EXPECT_NEAR(p, 1.0 - p_new_better(exchanged(older), exchanged(newer)), 1e-10);
  }
}

TEST(ProbabilityNewBetter, WithoutKicksIsHalf) { EXPECT_NEAR(p_new_better({0, 0}, {0, 0}), 0.5, 1e-12); }

TEST(ProbabilityNewBetter, OfExtremeAndHugeCountsIsCertain) {
  EXPECT_NEAR(p_new_better({0, 1000}, {1000, 1000}), 1.0, 1e-12);
  EXPECT_NEAR(p_new_better({1000, 1000}, {0, 1000}), 0.0, 1e-12);
  EXPECT_NEAR(p_new_better({500'000'000, 1'000'000'000}, {1, 2}), 0.5, 1e-9) << "one posterior far narrower";
  EXPECT_NEAR(p_new_better({500'000'000, 1'000'000'000}, {500'000'000, 1'000'000'000}), 0.5, 1e-6);
  EXPECT_NEAR(p_new_better({500'000'000, 1'000'000'000}, {501'000'000, 1'000'000'000}), 1.0, 1e-9);
}

}  // namespace
}  // namespace trivela::evaluator::stats
