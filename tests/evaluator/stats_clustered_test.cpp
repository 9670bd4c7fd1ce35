#include "evaluator/stats/clustered.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "evaluator/stats/counts/interval.hpp"
#include "evaluator/stats/counts/strata.hpp"
#include "evaluator/stats/off_policy.hpp"
#include "evaluator/stats/poisson.hpp"

namespace trivela::evaluator::stats {
namespace {

TEST(ClusteredDifference, NeedsFiveMatchesASide) {
  std::vector<MatchCounts> cells;
  for (std::uint32_t match = 0; match < 4; ++match) cells.push_back({match, 0, {2, 5}, {3, 5}});
  EXPECT_FALSE(clustered_difference(cells));
  cells.push_back({4, 0, {1, 5}, {}});
  EXPECT_FALSE(clustered_difference(cells)) << "the newer one has four still";
  cells.push_back({5, 0, {}, {4, 5}});
  EXPECT_TRUE(clustered_difference(cells));
  EXPECT_FALSE(clustered_difference({}));
}

TEST(ClusteredDifference, OfMatchesWithBothIsStudentsIntervalOfTheirDifferences) {
  // Equal sizes: the mean of the matches' own differences with their standard deviation.
  const std::vector<double> differences = {0.1, 0.3, 0.2, 0.0, 0.4, 0.2};
  std::vector<MatchCounts> cells;
  for (std::uint32_t match = 0; match < 30; ++match) {  // kManyMatches: what they show is believed
    const auto newer = static_cast<std::int64_t>(std::lround(10.0 * differences[match % 6])) + 3 + match % 2;
    cells.push_back({match, 0, {3 + match % 2, 10}, {newer, 10}});
  }
  double squares = 0.0;
  for (const double d : differences) squares += 5.0 * (d - 0.2) * (d - 0.2);
  const auto result = *clustered_difference(cells);
  EXPECT_NEAR(result.value, 0.2, 1e-12);
  EXPECT_NEAR(result.standard_error, std::sqrt(squares / 29.0 / 30.0), 1e-12);
  EXPECT_NEAR(result.df, 29.0, 1e-9);
  EXPECT_NEAR(result.ci.hi, 0.2 + 2.045229642 * result.standard_error, 1e-9);
}

TEST(ClusteredDifference, OfSeparateMatchesIsWelchs) {
  std::vector<MatchCounts> cells;
  const std::vector<std::int64_t> older = {3, 5, 4, 6, 2}, newer = {7, 6, 8, 5, 9, 7};
  for (std::uint32_t m = 0; m < 5; ++m) cells.push_back({m, 0, {older[m], 10}, {}});
  for (std::uint32_t m = 0; m < 6; ++m) cells.push_back({10 + m, 0, {}, {newer[m], 10}});
  const double v1 = 0.025 / 5.0, v2 = 0.02 / 6.0;  // variances of the matches' means over their number
  const auto result = *clustered_difference(cells);
  EXPECT_NEAR(result.value, 0.7 - 0.4, 1e-12);
  EXPECT_NEAR(result.standard_error, std::sqrt(v1 + v2), 1e-12);
  EXPECT_NEAR(result.df, (v1 + v2) * (v1 + v2) / (v1 * v1 / 4.0 + v2 * v2 / 5.0), 1e-9);
  EXPECT_EQ(result.older_matches, 5U);
  EXPECT_EQ(result.newer_matches, 6U);
}

TEST(ClusteredDifference, WeighsStrataByTheirShare) {
  std::vector<MatchCounts> cells;
  for (std::uint32_t m = 0; m < 6; ++m) {
    cells.push_back({m, 0, {m % 3, 4}, {m % 2 + 1, 4}});
    cells.push_back({m, 1, {m % 2 + 3, 6}, {m % 3 + 2, 6}});
    cells.push_back({m, 2, {0, 0}, {1, 2}});  // the newer one alone
  }
  // 6 matches: stratum 0 older 6/24, newer 9/24; stratum 1 older 21/36, newer 18/36.
  EXPECT_NEAR(clustered_difference(cells)->value, 0.4 * (9.0 - 6.0) / 24.0 + 0.6 * (18.0 - 21.0) / 36.0, 1e-12);
}

TEST(ClusteredDifference, IsNeverNarrowerThanThatOfIndependentKicksWhereMatchesAreFew) {
  for (const std::int64_t inside : {0, 1, 2}) {
    std::vector<MatchCounts> cells;  // all alike: by match alone there is no spread
    for (std::uint32_t m = 0; m < 6; ++m) cells.push_back({m, 0, {inside, 2}, {inside, 2}});
    const auto result = *clustered_difference(cells);
    const Interval independent = agresti_caffo({6 * inside, 12}, {6 * inside, 12});
    EXPECT_NEAR(result.ci.hi - result.ci.lo, independent.hi - independent.lo, 1e-12) << inside;
    EXPECT_GT(result.standard_error, 0.0);
  }
}

TEST(ClusteredDifference, HasWidthWhereNothingDiffersInManyMatches) {
  std::vector<MatchCounts> cells;
  for (std::uint32_t m = 0; m < 40; ++m) cells.push_back({m, 0, {4, 4}, {4, 4}});
  const auto result = *clustered_difference(cells);
  EXPECT_LT(result.ci.lo, -0.01);
  EXPECT_GT(result.ci.hi, 0.01);
}

TEST(ClusteredRateRatio, IsNeverNarrowerThanThatOfIndependentEventsWhereMatchesAreFew) {
  std::vector<MatchRates> matches;  // all alike: by match alone there is no spread
  for (std::uint32_t m = 0; m < 5; ++m) matches.push_back({m, {1, 1.0}, {2, 1.0}});
  const auto result = *clustered_rate_ratio(matches);
  const double reach = 1.96 * std::sqrt(1.0 / 5.0 + 1.0 / 10.0);
  EXPECT_NEAR(std::log(result.ci.hi / result.value), reach, 0.01);
  EXPECT_LT(result.ci.lo, 1.0);
  EXPECT_GT(result.p, 0.1);
}

TEST(RiskDifference, HasWidthWhereEveryKickIsInside) {
  const std::vector<Stratum> strata{{{5, 5}, {5, 5}}, {{4, 4}, {6, 6}}};
  const auto result = *mantel_haenszel_risk_difference(strata);
  EXPECT_EQ(result.value, 0.0);
  EXPECT_LT(result.ci.lo, -0.1);
  EXPECT_GT(result.ci.hi, 0.1);
}

TEST(OffPolicyValue, HasWidthWhereEveryShotIsOnTarget) {
  for (const std::size_t matches : {1u, 5u, 20u}) {
    std::vector<Trial> trials;
    for (std::uint32_t i = 0; i < 20; ++i)
      trials.push_back({i % 2 == 0, 0.5, 1.0, static_cast<std::uint32_t>(i % matches), {}});
    const PolicyValue value = off_policy_value(trials).snips;
    EXPECT_EQ(value.value, 1.0) << matches;
    EXPECT_LT(value.ci.lo, 0.95) << matches;
  }
}

TEST(ClusteredWilson, IsWilsonsWithFewerKicksAndNeverNarrower) {
  const std::vector<Counts> like = {{5, 10}, {5, 10}, {5, 10}, {5, 10}, {5, 10}, {5, 10}};
  const std::vector<Counts> unlike = {{0, 10}, {10, 10}, {0, 10}, {10, 10}, {0, 10}, {10, 10}};
  const Interval plain = wilson({30, 60});
  const Interval narrow = *clustered_wilson(like), wide = *clustered_wilson(unlike);
  EXPECT_LE(narrow.lo, plain.lo);
  EXPECT_LT(wide.lo, narrow.lo);
  EXPECT_GT(wide.lo, 0.0);
  EXPECT_FALSE(clustered_wilson(std::vector<Counts>{{5, 10}, {5, 10}, {0, 0}, {5, 10}, {5, 10}})) << "four have a kick";
}

}  // namespace
}  // namespace trivela::evaluator::stats
