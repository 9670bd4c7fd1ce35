// Statistics of one formula each against their reference values.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "evaluator/stats/bayes.hpp"
#include "evaluator/stats/counts/exact.hpp"
#include "evaluator/stats/counts/interval.hpp"
#include "evaluator/stats/poisson.hpp"
#include "evaluator/stats/test_plan.hpp"

namespace trivela::evaluator::stats {
namespace {

constexpr Counts kOld{34, 65};
constexpr Counts kNew{100, 132};

TEST(RateRatio, IsThatOfRsPoissonTest) {
  const auto ratio = *rate_ratio({34, 180.0}, {100, 300.0});
  EXPECT_NEAR(ratio.value, 1.764706, 5e-7);
  EXPECT_NEAR(ratio.ci.lo, 1.185109, 5e-7);
  EXPECT_NEAR(ratio.ci.hi, 2.686664, 5e-7);
  EXPECT_NEAR(ratio.p, 0.004115647, 5e-10);
}

TEST(RateRatio, WithoutEventsHasNoEndOrNoValue) {
  EXPECT_FALSE(rate_ratio({0, 10.0}, {0, 10.0}));
  EXPECT_TRUE(std::isinf(rate_ratio({0, 10.0}, {4, 10.0})->ci.hi));
  EXPECT_EQ(rate_ratio({4, 10.0}, {0, 10.0})->ci.lo, 0.0);
  EXPECT_NEAR(rate_ratio({7, 10.0}, {7, 10.0})->p, 1.0, 1e-12);
}

TEST(KicksPerPolicy, AreThoseOfRsPowerPropTest) {
  EXPECT_NEAR(*kicks_per_policy(0.52, 0.76), 61.6, 0.05);
  EXPECT_NEAR(*kicks_per_policy(0.52, 0.76, 0.9), 82.0, 0.05);
  const std::array wanted{1556.0, 384.0, 167.0, 92.0, 57.0};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ(std::ceil(*kicks_per_policy(0.52, 0.57 + 0.05 * static_cast<double>(i))), wanted[i]);
  }
  EXPECT_FALSE(kicks_per_policy(0.5, 0.5));
}

TEST(Holm, AdjustsAsRDoes) {
  const std::array p{0.0047, 0.03, 0.002, 0.2};
  const std::array wanted{0.0141, 0.0600, 0.0080, 0.2000};
  const auto adjusted = holm(p);
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(adjusted[i], wanted[i], 1e-15);
  EXPECT_EQ(holm(std::array{0.9, 0.9})[0], 1.0);
  EXPECT_TRUE(holm({}).empty());
}

TEST(SampleRatio, AlarmsWhereTheSharesAreNotThoseOfThePlan) {
  EXPECT_NEAR(*sample_ratio_p(std::array<std::int64_t, 2>{50, 50}, std::array{1.0, 1.0}), 1.0, 1e-15);
  // (60 - 50)^2 / 50 twice: 4 with one degree of freedom.
  EXPECT_NEAR(*sample_ratio_p(std::array<std::int64_t, 2>{60, 40}, std::array{0.5, 0.5}), std::erfc(std::sqrt(2.0)),
              1e-14);
  EXPECT_LT(*sample_ratio_p(std::array<std::int64_t, 2>{900, 1100}, std::array{1.0, 1.0}), kSampleRatioAlarm);
  EXPECT_FALSE(sample_ratio_p(std::array<std::int64_t, 1>{5}, std::array{1.0}));
}

TEST(AgrestiCaffo, OfTheTable2IsThatOfStatsmodels) {
  EXPECT_NEAR(agresti_caffo(kOld, kNew).lo, 0.0912491872, 5e-11);
  EXPECT_NEAR(agresti_caffo(kOld, kNew).hi, 0.3714373799, 5e-11);
  EXPECT_EQ(agresti_caffo({0, 0}, kNew).lo, -1.0);
}

TEST(Posterior, OfTheTable2IsThatOfR) {
  const auto difference = posterior_difference(kOld, kNew);
  EXPECT_NEAR(difference.median, 0.2315134133, 5e-10);
  EXPECT_NEAR(difference.central.lo, 0.0918767647, 5e-10);
  EXPECT_NEAR(difference.central.hi, 0.3698114358, 5e-10);
  EXPECT_NEAR(p_new_better(kOld, kNew, 0.05), 0.9947007787, 5e-10);
  EXPECT_NEAR(p_new_better(kOld, kNew, 0.10), 0.9674840609, 5e-10);
  EXPECT_NEAR(expected_loss_of_newer(kOld, kNew), 9.5791e-6, 5e-11);
}

TEST(Posterior, OfNoKicksIsSymmetric) {
  const auto difference = posterior_difference({0, 0}, {0, 0});
  EXPECT_NEAR(difference.median, 0.0, 1e-9);
  EXPECT_NEAR(difference.central.hi, 1.0 - std::sqrt(0.05), 1e-9) << "P(D > x) = (1 - x)^2 / 2";
  EXPECT_NEAR(expected_loss_of_newer({0, 0}, {0, 0}), 1.0 / 6.0, 1e-9);
  EXPECT_NEAR(p_new_better({0, 0}, {0, 0}, -1.0), 1.0, 1e-9);
  EXPECT_NEAR(p_new_better({0, 0}, {0, 0}, 1.0), 0.0, 1e-9);
}

TEST(Fragility, OfTheTable2IsTheNumberOfFlips) {
  const auto flips = *fragility(kOld, kNew);
  EXPECT_EQ(flips.newer, 12);
  EXPECT_EQ(flips.older, 7);
  const auto mirrored = *fragility(kNew, kOld);
  EXPECT_EQ(mirrored.newer, 7);
  EXPECT_EQ(mirrored.older, 12);
  EXPECT_FALSE(fragility({5, 10}, {6, 10})) << "not significant to begin with";
}

TEST(DifferenceBounds, TakeEveryUnknownKickEitherWay) {
  const auto bounds = difference_bounds({{5, 8}, 2}, {{6, 9}, 1});
  EXPECT_NEAR(bounds.lo, 0.6 - 0.7, 1e-15);
  EXPECT_NEAR(bounds.hi, 0.7 - 0.5, 1e-15);
  EXPECT_EQ(difference_bounds({{0, 0}, 0}, {{6, 9}, 1}).lo, -1.0);
}

TEST(MostWrong, IsTheUpperQuantileOfPoisson) {
  EXPECT_EQ(most_wrong(0.0), 0);
  EXPECT_EQ(most_wrong(0.02), 0) << "R: qpois(0.975, 0.02)";
  EXPECT_EQ(most_wrong(0.03), 1);
  EXPECT_EQ(most_wrong(1.0), 3);
  EXPECT_EQ(most_wrong(4.0), 8);
  EXPECT_EQ(most_wrong(30.0), 41);
  EXPECT_NEAR(static_cast<double>(most_wrong(500.1)), 545.0, 1.0);
}

TEST(EfficiencyBounds, CountLabelsThatMayBeWrongAgainstTheGroupAndForIt) {
  const auto bounds = efficiency_bounds({{50, 90}, 10, {1.0, 4.0}});
  EXPECT_NEAR(bounds.lo, 0.47, 1e-15) << "3 of the labels of inside are wrong";
  EXPECT_NEAR(bounds.hi, 0.68, 1e-15) << "10 unknown and 8 of the labels of outside are inside";
  EXPECT_NEAR(efficiency_bounds({{1, 1}, 0, {1.0, 4.0}}).lo, 0.0, 1e-15) << "not more than there are";
  EXPECT_NEAR(efficiency_bounds({{1, 1}, 0, {1.0, 4.0}}).hi, 1.0, 1e-15);
  EXPECT_EQ(efficiency_bounds({}).lo, 0.0);
  EXPECT_EQ(efficiency_bounds({}).hi, 1.0);
}

TEST(EValue, OfTheTable2IsThePublishedFormulas) {
  EXPECT_NEAR(e_value(1.4483065954), 2.2541, 5e-5);
  EXPECT_NEAR(e_value(1.1263746373), 1.5037, 5e-5);
  EXPECT_NEAR(e_value(1.0 / 1.4483065954), e_value(1.4483065954), 1e-12);
  EXPECT_EQ(e_value(1.0), 1.0);
}

TEST(Verdict, HasFiveClasses) {
  EXPECT_EQ(verdict({0.093, 0.370}), Verdict::kBetter);
  EXPECT_EQ(verdict({0.02, 0.20}), Verdict::kBetterMaybeTooSmall);
  EXPECT_EQ(verdict({-0.04, 0.03}), Verdict::kEquivalent);
  EXPECT_EQ(verdict({0.01, 0.03}), Verdict::kEquivalent) << "clear of zero, yet too small to matter";
  EXPECT_EQ(verdict({-0.20, -0.01}), Verdict::kWorse);
  EXPECT_EQ(verdict({-0.10, 0.10}), Verdict::kNotEnoughData);
  EXPECT_EQ(verdict({-0.02, 0.20}), Verdict::kNotEnoughData);
  EXPECT_EQ(verdict({0.02, 0.20}, 0.01), Verdict::kBetter) << "the smallest effect is the reader's";
}

}  // namespace
}  // namespace trivela::evaluator::stats
