#include "evaluator/stats/paired.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evaluator/stats/counts/exact.hpp"
#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {
namespace {

TEST(BinomialTest, EqualsItsDefinition) {
  const auto choose = [](int n, int k) {
    return std::exp(std::lgamma(n + 1.) - std::lgamma(k + 1.) - std::lgamma(n - k + 1.));
  };
  for (const double p : {0.1, 0.5, 0.73}) {
    for (int n = 1; n <= 14; ++n) {
      for (int k = 0; k <= n; ++k) {
        const auto pmf = [&](int x) { return choose(n, x) * std::pow(p, x) * std::pow(1.0 - p, n - x); };
        double sum = 0.0;
        for (int x = 0; x <= n; ++x) sum += pmf(x) <= pmf(k) * (1.0 + 1e-7) ? pmf(x) : 0.0;
        EXPECT_NEAR(binomial_two_sided({k, n}, p), std::min(sum, 1.0), 1e-11) << k << " of " << n << " at " << p;
      }
    }
  }
  EXPECT_EQ(binomial_two_sided({0, 0}, 0.5), 1.0);
}

TEST(ClopperPearson, OfTheTable2IsThatOfR) {
  EXPECT_NEAR(clopper_pearson({34, 65}).lo, 0.3954424614, 1e-10);
  EXPECT_NEAR(clopper_pearson({34, 65}).hi, 0.6485403192, 1e-10);
  EXPECT_NEAR(clopper_pearson({100, 132}).lo, 0.6753447480, 1e-10);
  EXPECT_NEAR(clopper_pearson({100, 132}).hi, 0.8278934590, 1e-10);
  EXPECT_EQ(clopper_pearson({0, 9}).lo, 0.0);
  EXPECT_EQ(clopper_pearson({9, 9}).hi, 1.0);
}

TEST(McNemar, IsTheExactTestOfR) {
  EXPECT_NEAR(mcnemar_two_sided({.both = 3, .newer_only = 25, .older_only = 9, .neither = 4}), 0.0090411855, 5e-11);
  EXPECT_NEAR(mcnemar_two_sided({.newer_only = 9, .older_only = 25}), 0.0090411855, 5e-11);
}

TEST(McNemar, SaysNothingWherePoliciesNeverDiffer) {
  EXPECT_EQ(mcnemar_two_sided({.both = 70, .neither = 30}), 1.0);
  EXPECT_EQ(mcnemar_two_sided({}), 1.0);
}

TEST(PairedNewcombe, WithoutCorrelationIsTheUnpairedInterval) {
  const PairedCounts pairs{.both = 6, .newer_only = 24, .older_only = 14, .neither = 56};  // phi = 0
  const Interval unpaired = newcombe(pairs.older(), pairs.newer());
  EXPECT_NEAR(paired_newcombe(pairs).lo, unpaired.lo, 1e-12);
  EXPECT_NEAR(paired_newcombe(pairs).hi, unpaired.hi, 1e-12);
}

TEST(PairedNewcombe, OfAHandCase) {
  // p1 = 0.5, p2 = 0.7 of 100; phi = (40 * 20 - 30 * 10 - 50) / sqrt(70 * 30 * 50 * 50).
  const PairedCounts pairs{.both = 40, .newer_only = 30, .older_only = 10, .neither = 20};
  const double phi = 450.0 / std::sqrt(70.0 * 30.0 * 50.0 * 50.0);
  const Interval w1 = wilson({50, 100}), w2 = wilson({70, 100});
  const double b = 0.7 - w2.lo, a = w1.hi - 0.5;
  EXPECT_NEAR(paired_newcombe(pairs).lo, 0.2 - std::sqrt(a * a + b * b - 2.0 * phi * a * b), 1e-12);
}

TEST(PairedNewcombe, HoldsItsEstimateStaysInRangeAndMirrors) {
  for (int both = 0; both <= 6; both += 3) {
    for (int newer = 0; newer <= 6; newer += 2) {
      for (int older = 0; older <= 6; older += 2) {
        for (int neither = 0; neither <= 6; neither += 3) {
          const PairedCounts pairs{both, newer, older, neither};
          if (pairs.n() == 0) continue;
          const Interval ci = paired_newcombe(pairs);
          const double d = static_cast<double>(newer - older) / static_cast<double>(pairs.n());
          EXPECT_LE(ci.lo, d + 1e-12);
          EXPECT_GE(ci.hi, d - 1e-12);
          EXPECT_GE(ci.lo, -1.0 - 1e-12);
          EXPECT_LE(ci.hi, 1.0 + 1e-12);
          EXPECT_NEAR(ci.lo, -paired_newcombe({both, older, newer, neither}).hi, 1e-12);
        }
      }
    }
  }
  EXPECT_EQ(paired_newcombe({}).lo, -1.0);
}

}  // namespace
}  // namespace trivela::evaluator::stats
