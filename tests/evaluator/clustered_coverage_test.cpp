// The same for what is alike within a match, or within a calibration.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "evaluator/stats/clustered.hpp"
#include "evaluator/stats/counts/interval.hpp"
#include "evaluator/stats/poisson.hpp"
#include "tests/evaluator/coverage.hpp"

namespace trivela::evaluator::stats {
namespace {

// A match whose day shifts every kick: intraclass correlation of about 0.1.
double of_the_day(RandomNumbers& random, double p) { return p + (random.happens(0.5) ? 0.15 : -0.15); }

std::int64_t kicks_of_a_match(RandomNumbers& random) { return 8 + static_cast<std::int64_t>(10.0 * random.uniform()); }

TEST(Coverage, DifferenceFromSeparateMatches) {
  std::vector<double> naive;
  const auto experiment = [&](RandomNumbers& random) {
    std::vector<MatchCounts> cells;
    for (std::uint32_t m = 0; m < 10; ++m)
      cells.push_back({m, 0, random.kicks(kicks_of_a_match(random), of_the_day(random, 0.5)), {}});
    for (std::uint32_t m = 20; m < 32; ++m)
      cells.push_back({m, 0, {}, random.kicks(kicks_of_a_match(random), of_the_day(random, 0.7))});
    return cells;
  };
  EXPECT_NOMINAL(coverage(
      0.2, [&](auto& random) -> std::optional<Interval> { return clustered_difference(experiment(random))->ci; }));
  const double independent = coverage(0.2, [&](auto& random) {
    Counts older, newer;
    for (const MatchCounts& cell : experiment(random)) {
      older = {older.inside + cell.older.inside, older.n + cell.older.n};
      newer = {newer.inside + cell.newer.inside, newer.n + cell.newer.n};
    }
    return newcombe(older, newer);
  });
  EXPECT_LT(independent, 0.90) << "taking these kicks as independent is too sure: why there is another interval";
}

TEST(Coverage, DifferenceFromTheSameMatchesAndStrata) {
  EXPECT_NOMINAL(coverage(0.1, [](auto& random) -> std::optional<Interval> {
    std::vector<MatchCounts> cells;
    for (std::uint32_t m = 0; m < 12; ++m) {
      const double day = random.happens(0.5) ? 0.15 : -0.15;
      cells.push_back({m, 0, random.kicks(7, 0.6 + day), random.kicks(7, 0.7 + day)});
      cells.push_back({m, 1, random.kicks(7, 0.3 + day), random.kicks(7, 0.4 + day)});
    }
    return clustered_difference(cells)->ci;
  }));
}

// Matches of these sizes with one policy or, the first ones, with both; a day shifts every kick of a match.
struct FewMatches {
  const char* name;
  std::vector<std::int64_t> older;
  std::vector<std::int64_t> newer;
  std::size_t shared = 0;  // the first ones of either are the same matches
};

std::vector<MatchCounts> play(RandomNumbers& random, const FewMatches& few) {
  std::vector<MatchCounts> cells;
  for (std::size_t i = 0; i < few.older.size(); ++i) {
    const double day = of_the_day(random, 0.0);
    cells.push_back({static_cast<std::uint32_t>(i), 0, random.kicks(few.older[i], 0.5 + day), {}});
    if (i < few.shared) cells.back().newer = random.kicks(few.newer[i], 0.7 + day);
  }
  for (std::size_t i = few.shared; i < few.newer.size(); ++i) {
    const double day = of_the_day(random, 0.0);
    cells.push_back({static_cast<std::uint32_t>(100 + i), 0, {}, random.kicks(few.newer[i], 0.7 + day)});
  }
  return cells;
}

TEST(Coverage, DifferenceFromFewUnequalAndPartlySharedMatches) {
  const std::vector<std::int64_t> unequal = {60, 30, 15, 8, 4}, other = {4, 60, 8, 15, 30};
  const std::vector<std::int64_t> one_big = {200, 20, 20, 20, 20}, big_other = {20, 200, 20, 20, 20};
  const std::vector<std::int64_t> five(5, 13), eight = {60, 30, 15, 8, 4, 4, 8, 15}, forty(40, 13);
  for (const FewMatches& few : {FewMatches{"five a side", five, five}, FewMatches{"five unequal", unequal, other},
                                FewMatches{"five, one of them big", one_big, big_other},
                                FewMatches{"five and forty, one shared", five, forty, 1},
                                FewMatches{"five unequal and forty, one shared", unequal, forty, 1},
                                FewMatches{"the largest alone is shared", {60, 5, 5, 5, 5}, forty, 1},
                                FewMatches{"eight unequal, three shared", eight, {4, 60, 8, 15, 30, 20, 5, 5}, 3},
                                FewMatches{"six unequal, all shared", {60, 30, 15, 8, 4, 4}, {30, 50, 15, 4, 8, 5}, 6},
                                FewMatches{"five a side, two shared", five, five, 2}}) {
    const double share = coverage(
        0.2, [&](auto& random) -> std::optional<Interval> { return clustered_difference(play(random, few))->ci; });
    EXPECT_GE(share, kLow) << few.name;
  }
}

// Matches crossed with calibrations, each of which shifts the newer policy's kicks.
TEST(Coverage, DifferenceFromMatchesCrossedWithCalibrations) {
  for (const auto& crossed : {std::pair{25U, 20U}, {30U, 6U}}) {
    const std::uint32_t matches = crossed.first, calibrations = crossed.second;
    int conditional = 0;
    const double share = coverage(0.2, [&](auto& random) -> std::optional<Interval> {
      std::vector<MatchCounts> cells;
      std::vector<double> day(matches);
      for (double& shift : day) shift = of_the_day(random, 0.0);
      for (std::uint32_t k = 0; k < calibrations; ++k) {
        const double calibration = 0.08 * (random.uniform() + random.uniform() - 1.0);
        for (std::uint32_t m = 0; m < matches; ++m)
          cells.push_back({m, 0, random.kicks(8, 0.5 + day[m]), random.kicks(8, 0.7 + day[m] + calibration), k});
      }
      const Interval ci = clustered_difference(cells)->ci;
      for (MatchCounts& cell : cells) cell.calibration = 0;
      const Interval alone = clustered_difference(cells)->ci;
      conditional += alone.lo <= 0.2 && 0.2 <= alone.hi ? 1 : 0;
      return ci;
    });
    EXPECT_GE(share, kLow);
    EXPECT_LT(conditional, 900) << "taking the calibrations for granted is too sure";
  }
}

TEST(Coverage, WilsonFromMatches) {
  EXPECT_CONSERVATIVE(coverage(0.6, [](auto& random) {
    std::vector<Counts> matches;
    for (int m = 0; m < 12; ++m) matches.push_back(random.kicks(kicks_of_a_match(random), of_the_day(random, 0.6)));
    return clustered_wilson(matches);
  }));
}

// The fewest matches: a comparison has intervals by match where there are enough, else of independent kicks.
TEST(Coverage, OfOneKickAMatchHoldsFromThreeMatchesOn) {
  for (const std::uint32_t n : {3u, 4u, 5u, 6u, 8u, 11u, 12u, 20u, 30u}) {
    for (const double p : {0.5, 0.9, 0.99}) {
      const double share = coverage(p, [&](auto& random) -> std::optional<Interval> {
        std::vector<Counts> matches;
        Counts total;
        for (std::uint32_t m = 0; m < n; ++m) {
          matches.push_back(random.kicks(1, p));
          total = {total.inside + matches.back().inside, total.n + 1};
        }
        const auto by_match = clustered_wilson(matches);
        return by_match ? by_match : wilson_or_exact(total);
      });
      EXPECT_GE(share, kLow) << "efficiency of " << n << " matches at " << p;
      const double difference = coverage(0.0, [&](auto& random) -> std::optional<Interval> {
        std::vector<MatchCounts> cells;
        Counts older, newer;
        for (std::uint32_t m = 0; m < n; ++m) {
          cells.push_back({m, 0, random.kicks(1, p), random.kicks(1, p)});
          older = {older.inside + cells.back().older.inside, older.n + 1};
          newer = {newer.inside + cells.back().newer.inside, newer.n + 1};
        }
        const auto by_match = clustered_difference(cells);
        return by_match ? by_match->ci : newcombe_or_exact(older, newer);
      });
      EXPECT_GE(difference, kLow) << "difference of " << n << " matches at " << p;
    }
  }
}

// Halves of the same matches: at most one kick of a possession, possessions at an almost steady pace.
TEST(Coverage, RateRatioOfAtMostOneKickAnOpportunity) {
  int poisson = 0;
  const double share = coverage(0.8 / 0.6, [&](auto& random) -> std::optional<Interval> {
    std::vector<MatchRates> matches;
    Rate older, newer;
    for (std::uint32_t m = 0; m < 12; ++m) {
      const std::int64_t possessions = 28 + static_cast<std::int64_t>(5.0 * random.uniform());
      const double minutes = 0.25 * static_cast<double>(possessions);
      matches.push_back(
          {m, {random.kicks(possessions, 0.6).inside, minutes}, {random.kicks(possessions, 0.8).inside, minutes}});
      older = {older.events + matches.back().older.events, older.minutes + minutes};
      newer = {newer.events + matches.back().newer.events, newer.minutes + minutes};
    }
    const Interval exact = rate_ratio(older, newer)->ci;
    poisson += exact.lo <= 0.8 / 0.6 && 0.8 / 0.6 <= exact.hi ? 1 : 0;
    return clustered_rate_ratio(matches)->ci;
  });
  EXPECT_NOMINAL(share);
  EXPECT_GT(poisson, 985) << "Poisson's variance is far too large for such kicks";
}

TEST(Coverage, RateRatioOfFewMatchesIsConservative) {
  for (const std::uint32_t n : {5u, 10u}) {
    EXPECT_CONSERVATIVE(coverage(0.8 / 0.6, [n](auto& random) -> std::optional<Interval> {
      std::vector<MatchRates> matches;
      for (std::uint32_t m = 0; m < n; ++m)
        matches.push_back({m, {random.kicks(30, 0.6).inside, 7.5}, {random.kicks(30, 0.8).inside, 7.5}});
      return clustered_rate_ratio(matches)->ci;
    }));
  }
}

TEST(Coverage, RateRatioIsConservative) {
  EXPECT_CONSERVATIVE(coverage(1.5, [](auto& random) -> std::optional<Interval> {
    const Rate older{random.poisson(30.0), 20.0};
    return rate_ratio(older, {random.poisson(54.0), 24.0})->ci;
  }));
}

}  // namespace
}  // namespace trivela::evaluator::stats
