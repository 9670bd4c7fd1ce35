#include "evaluator/stats/counts/exact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/evaluator/count_sweep.hpp"

namespace trivela::evaluator::stats {
namespace {

constexpr Counts kOld{34, 65};  // the paper's Table 2
constexpr Counts kNew{100, 132};

double choose(std::int64_t n, std::int64_t k) {
  double result = 1.0;
  for (std::int64_t i = 1; i <= k; ++i) result *= static_cast<double>(n - k + i) / static_cast<double>(i);
  return result;
}

// Fisher's one-sided p from the definition.
double fisher_by_hand(Counts older, Counts newer) {
  const std::int64_t total = older.inside + newer.inside;
  double tail = 0.0;
  for (std::int64_t x = newer.inside; x <= std::min(total, newer.n); ++x) {
    if (total - x <= older.n) tail += choose(newer.n, x) * choose(older.n, total - x);
  }
  return tail / choose(older.n + newer.n, total);
}

TEST(Fisher, OfTheTable2IsThatOfR) {
  EXPECT_NEAR(fisher_two_sided(kOld, kNew), 0.0011768787, 5e-11);
  EXPECT_NEAR(fisher_one_sided(kOld, kNew), 0.0009014346, 5e-11);
}

TEST(Fisher, OfTheLadyTastingTea) {
  EXPECT_NEAR(fisher_one_sided({1, 4}, {3, 4}), 17.0 / 70.0, 1e-15);
  EXPECT_NEAR(fisher_two_sided({1, 4}, {3, 4}), 34.0 / 70.0, 1e-15);
  EXPECT_NEAR(fisher_one_sided({0, 4}, {4, 4}), 1.0 / 70.0, 1e-15);
}

TEST(Fisher, EqualsItsDefinitionAndIsSymmetric) {
  for_pairs(9, [](Counts older, Counts newer) {
    const double better = fisher_one_sided(older, newer);
    const double worse = fisher_one_sided(newer, older);
    const double both = fisher_two_sided(older, newer);
    EXPECT_NEAR(better, fisher_by_hand(older, newer), 1e-12);
    EXPECT_NEAR(better, fisher_one_sided(exchanged(newer), exchanged(older)), 1e-12);
    EXPECT_NEAR(both, fisher_two_sided(newer, older), 1e-12);
    EXPECT_NEAR(both, fisher_two_sided(exchanged(older), exchanged(newer)), 1e-12);
    EXPECT_GE(both, std::min(better, worse) - 1e-15);
    EXPECT_GE(better + worse, 1.0 - 1e-12) << "both hold the table seen";
    for (const double p : {better, worse, both}) EXPECT_TRUE(p >= 0.0 && p <= 1.0) << p;
  });
}

TEST(Fisher, CountsWithoutKicksShowNothing) {
  EXPECT_EQ(fisher_one_sided({0, 0}, kNew), 1.0);
  EXPECT_EQ(fisher_two_sided(kOld, {0, 0}), 1.0);
  EXPECT_EQ(fisher_two_sided({0, 0}, {0, 0}), 1.0);
}

TEST(Fisher, HugeCountsGoOverToTheNormalTest) {
  const Counts older{500'000, 1'000'000};
  const Counts newer{501'000, 1'000'000};
  const double z = 0.001 / std::sqrt(0.5005 * 0.4995 * 2e-6);
  EXPECT_NEAR(fisher_one_sided(older, newer), 0.5 * std::erfc(z / std::sqrt(2.0)), 3e-4);
  EXPECT_NEAR(fisher_two_sided({5'000'000, 10'000'000}, {5'000'000, 10'000'000}), 1.0, 1e-9);
  EXPECT_LT(fisher_two_sided({0, 1'000'000}, {1'000'000, 1'000'000}), 1e-280) << "vanishes, but is no error";
}

TEST(Boschloo, OfTheTable2IsThatOfScipy) {
  EXPECT_NEAR(*boschloo_one_sided(kOld, kNew), 0.0005579792, 1e-9);
  EXPECT_NEAR(*boschloo_two_sided_doubled(kOld, kNew), 0.0011159585, 1e-9);
}

// The supremum over a fine grid of the sum over every table whose Fisher p is not above that of the table seen.
double boschloo_by_hand(Counts older, Counts newer) {
  const double limit = fisher_by_hand(older, newer) * (1.0 + 1e-9);
  double best = 0.0;
  for (int step = 0; step <= 400; ++step) {
    const double p = step / 400.0;
    double sum = 0.0;
    for (std::int64_t k1 = 0; k1 <= older.n; ++k1) {
      for (std::int64_t k2 = 0; k2 <= newer.n; ++k2) {
        if (fisher_by_hand({k1, older.n}, {k2, newer.n}) > limit) continue;
        sum += choose(older.n, k1) * choose(newer.n, k2) * std::pow(p, static_cast<double>(k1 + k2)) *
               std::pow(1.0 - p, static_cast<double>(older.n + newer.n - k1 - k2));
      }
    }
    best = std::max(best, sum);
  }
  return best;
}

TEST(Boschloo, EqualsItsDefinition) {
  for (const auto& [older, newer] : {std::pair{Counts{1, 5}, Counts{4, 6}}, std::pair{Counts{0, 3}, Counts{5, 7}},
                                     std::pair{Counts{3, 4}, Counts{1, 6}}, std::pair{Counts{2, 8}, Counts{3, 3}}}) {
    const double p = *boschloo_one_sided(older, newer);
    const double by_hand = boschloo_by_hand(older, newer);
    EXPECT_GE(p, by_hand - 1e-12) << "the grid may miss the supremum, but not exceed it";
    EXPECT_NEAR(p, by_hand, 1e-4);
  }
}

TEST(Boschloo, IsNeverLargerThanFisherAndSymmetric) {
  for_pairs(5, [](Counts older, Counts newer) {
    const double p = *boschloo_one_sided(older, newer);
    EXPECT_TRUE(p >= 0.0 && p <= 1.0);
    EXPECT_LE(p, fisher_one_sided(older, newer) * (1.0 + 1e-9));
    EXPECT_NEAR(p, *boschloo_one_sided(exchanged(newer), exchanged(older)), 1e-9);
  });
}

TEST(Boschloo, WithoutKicksIsOneAndOfTooManyIsNotComputed) {
  EXPECT_EQ(boschloo_one_sided({0, 0}, kNew), 1.0);
  EXPECT_EQ(boschloo_two_sided_doubled({0, 0}, {0, 0}), 1.0);
  EXPECT_EQ(boschloo_one_sided({5, 9'000}, {6, 1'001}), std::nullopt);
}

}  // namespace
}  // namespace trivela::evaluator::stats
