#include "evaluator/stats/counts/strata.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "evaluator/stats/counts/exact.hpp"
#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {
namespace {

// Near and far kicks of two policies; the newer one is better at either distance, but kicks from afar.
const std::vector<Stratum> kNearAndFar = {{{45, 50}, {28, 30}}, {{5, 25}, {45, 120}}};

// R's UCBAdmissions: admitted men (newer) and women (older) of the departments A to F.
const std::vector<Stratum> kAdmissions = {{{89, 108}, {512, 825}},  {{17, 25}, {353, 560}}, {{202, 593}, {120, 325}},
                                          {{131, 375}, {138, 417}}, {{94, 393}, {53, 191}}, {{24, 341}, {22, 373}}};

TEST(MantelHaenszel, OfTheAdmissionsIsThatOfR) {
  const auto odds = *mantel_haenszel_odds_ratio(kAdmissions);
  EXPECT_NEAR(odds.value, 0.904696828, 5e-10);
  EXPECT_NEAR(odds.ci.lo, 0.771907362, 5e-10);
  EXPECT_NEAR(odds.ci.hi, 1.060329764, 5e-10);
  const auto plain = *cochran_mantel_haenszel(kAdmissions);
  EXPECT_NEAR(plain.statistic, 1.524606660, 5e-9);
  EXPECT_NEAR(plain.p, 0.216923697, 5e-10);
  const auto corrected = *cochran_mantel_haenszel(kAdmissions, true);
  EXPECT_NEAR(corrected.statistic, 1.426946229, 5e-10);
  EXPECT_NEAR(corrected.p, 0.232263463, 5e-10);
  EXPECT_NEAR(odds_ratio({557, 1835}, {1198, 2691})->value, 1.84108004, 5e-9) << "crude";
}

TEST(MantelHaenszel, OfTheKicksIsThatOfR) {
  EXPECT_NEAR(odds_ratio({50, 75}, {73, 150})->value, 0.474025974, 5e-10);
  EXPECT_NEAR(fisher_two_sided({50, 75}, {73, 150}), 0.0110500721, 5e-11);
  const auto odds = *mantel_haenszel_odds_ratio(kNearAndFar);
  EXPECT_NEAR(odds.value, 2.144018583, 5e-10);
  EXPECT_NEAR(odds.ci.lo, 0.8801687640, 5e-11);
  EXPECT_NEAR(odds.ci.hi, 5.222652600784, 5e-10);
  const auto test = *cochran_mantel_haenszel(kNearAndFar);
  EXPECT_NEAR(test.statistic, 2.896785281, 5e-10);
  EXPECT_NEAR(test.p, 0.088756399, 5e-10);
  const auto risk = *mantel_haenszel_risk_difference(kNearAndFar);
  EXPECT_NEAR(risk.value, 0.107650273, 5e-10);
  EXPECT_NEAR(risk.ci.lo, -0.004414315, 5e-10);
  EXPECT_NEAR(risk.ci.hi, 0.219714861, 5e-10);
}

TEST(MantelHaenszel, OfAnExcessBelowOneHalfIsNotCorrected) {
  // R: mantelhaen.test(array(c(6, 5, 5, 5, 4, 5, 5, 5), dim = c(2, 2, 2))), with and without correction the same.
  const std::vector<Stratum> strata = {{{5, 10}, {6, 11}}, {{5, 10}, {4, 9}}};
  for (const bool corrected : {true, false}) {
    EXPECT_NEAR(cochran_mantel_haenszel(strata, corrected)->statistic, 0.000239891569011, 1e-14);
    EXPECT_NEAR(cochran_mantel_haenszel(strata, corrected)->p, 0.987642512201800, 1e-12);
  }
}

TEST(Standardised, OfTheKicksTurnsTheCrudeOrderAround) {
  const auto result = *standardised(kNearAndFar);
  EXPECT_NEAR(result.newer, 0.573518519, 5e-10);
  EXPECT_NEAR(result.older, 0.448888889, 5e-10);
  EXPECT_NEAR(result.difference.value, 0.573518519 - 0.448888889, 1e-9);
}

TEST(Standardised, OfOneStratumIsNewcombes) {
  const std::vector<Stratum> one = {{{34, 65}, {100, 132}}};
  const auto result = *standardised(one);
  EXPECT_NEAR(result.difference.ci.lo, 0.0931659315, 5e-11);
  EXPECT_NEAR(result.difference.ci.hi, 0.3704118230, 5e-11);
}

TEST(Standardised, UsesOnlyStrataOfBothPolicies) {
  auto strata = kNearAndFar;
  strata.push_back({{0, 0}, {9, 40}});
  strata.push_back({{3, 7}, {0, 0}});
  EXPECT_NEAR(standardised(strata)->newer, 0.573518519, 5e-10);
  EXPECT_NEAR(mantel_haenszel_risk_difference(strata)->value, 0.107650273, 5e-10);
  EXPECT_NEAR(mantel_haenszel_odds_ratio(strata)->value, 2.144018583, 5e-10);
  EXPECT_NEAR(breslow_day(strata)->statistic, 0.181392213, 5e-10);
}

TEST(BreslowDay, OfTheKicksIsThatOfStatsmodels) {
  const auto test = *breslow_day(kNearAndFar);
  EXPECT_NEAR(test.statistic, 0.181392213, 5e-10);
  EXPECT_NEAR(test.p, 0.670179515, 5e-10);
  EXPECT_EQ(test.df, 1.0);
}

TEST(BreslowDay, OfLikeStrataIsNothing) {
  const std::vector<Stratum> like = {{{10, 20}, {15, 20}}, {{20, 40}, {30, 40}}};
  EXPECT_NEAR(breslow_day(like)->statistic, 0.0, 1e-12);
  const std::vector<Stratum> no_difference = {{{10, 20}, {10, 20}}, {{5, 20}, {5, 20}}};
  EXPECT_NEAR(breslow_day(no_difference)->statistic, 0.0, 1e-12) << "a common odds ratio of 1";
}

TEST(Strata, WithoutKicksOrWithOneResultOnlyGiveNoNumber) {
  const std::vector<Stratum> none;
  const std::vector<Stratum> all_inside = {{{5, 5}, {7, 7}}, {{2, 2}, {3, 3}}};
  const std::vector<Stratum> apart = {{{5, 9}, {0, 0}}, {{0, 0}, {3, 8}}};
  for (const auto& strata : {none, all_inside, apart}) {
    EXPECT_FALSE(mantel_haenszel_odds_ratio(strata));
    EXPECT_FALSE(cochran_mantel_haenszel(strata));
    EXPECT_FALSE(breslow_day(strata));
  }
  EXPECT_FALSE(standardised(none));
  EXPECT_FALSE(standardised(apart));
  EXPECT_FALSE(mantel_haenszel_risk_difference(apart));
  EXPECT_EQ(standardised(all_inside)->difference.value, 0.0);
}

}  // namespace
}  // namespace trivela::evaluator::stats
