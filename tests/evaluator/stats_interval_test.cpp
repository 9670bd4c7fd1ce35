#include "evaluator/stats/counts/interval.hpp"

#include <gtest/gtest.h>

#include "tests/evaluator/count_sweep.hpp"

namespace trivela::evaluator::stats {
namespace {

constexpr Counts kOld{34, 65};  // the paper's Table 2
constexpr Counts kNew{100, 132};
constexpr double kDigits = 1e-10;

void expect_interval(Interval interval, double lo, double hi) {
  EXPECT_NEAR(interval.lo, lo, kDigits);
  EXPECT_NEAR(interval.hi, hi, kDigits);
}

TEST(Intervals, OfTheTable2AreThoseOfRAndStatsmodels) {
  EXPECT_NEAR(*efficiency(kOld), 0.5230769231, kDigits);
  EXPECT_NEAR(*efficiency(kNew), 0.7575757576, kDigits);
  expect_interval(wilson(kOld), 0.4037962961, 0.6397820947);
  expect_interval(wilson(kNew), 0.6778581786, 0.8227253736);
  expect_interval(newcombe(kOld, kNew), 0.0931659315, 0.3704118230);
  EXPECT_NEAR(*relative_gain(kOld, kNew), 0.4483065954, kDigits);
  EXPECT_NEAR(risk_ratio(kOld, kNew)->value, 1.4483065954, kDigits);
  expect_interval(risk_ratio(kOld, kNew)->ci, 1.1263746373, 1.8622507332);
  EXPECT_NEAR(odds_ratio(kOld, kNew)->value, 2.8492647059, kDigits);
  expect_interval(odds_ratio(kOld, kNew)->ci, 1.5193499145, 5.3432782580);
}

TEST(Intervals, HoldTheirEstimateAndStayInRange) {
  for_pairs(14, [](Counts older, Counts newer) {
    const Interval w = wilson(older);
    EXPECT_GE(w.lo, 0.0);
    EXPECT_LE(w.hi, 1.0);
    if (const auto p = efficiency(older)) {
      EXPECT_TRUE(w.lo <= *p && *p <= w.hi) << older.inside << "/" << older.n;
    }
    const Interval d = newcombe(older, newer);
    EXPECT_GE(d.lo, -1.0 - 1e-15);
    EXPECT_LE(d.hi, 1.0 + 1e-15);
    EXPECT_LE(d.lo, d.hi);
    if (older.n > 0 && newer.n > 0) {
      const double difference = *efficiency(newer) - *efficiency(older);
      EXPECT_TRUE(d.lo <= difference && difference <= d.hi);
    }
    if (const auto ratio = risk_ratio(older, newer)) {
      EXPECT_TRUE(ratio->ci.lo <= ratio->value * (1 + 1e-15) && ratio->value <= ratio->ci.hi * (1 + 1e-15));
    }
  });
}

TEST(Intervals, MirrorWhenTheGroupsOrInsideAndOutsideAreExchanged) {
  for_pairs(9, [](Counts older, Counts newer) {
    const Interval d = newcombe(older, newer);
    const Interval groups = newcombe(newer, older);
    const Interval sides = newcombe(exchanged(older), exchanged(newer));
    EXPECT_NEAR(d.lo, -groups.hi, 1e-14);
    EXPECT_NEAR(d.lo, -sides.hi, 1e-14);
    EXPECT_NEAR(wilson(older).lo, 1.0 - wilson(exchanged(older)).hi, 1e-14);
    if (const auto ratio = risk_ratio(older, newer)) {
      EXPECT_NEAR(ratio->ci.lo * risk_ratio(newer, older)->ci.hi, 1.0, 1e-12);
    }
    if (const auto ratio = odds_ratio(older, newer)) {
      EXPECT_NEAR(ratio->ci.lo * odds_ratio(exchanged(older), exchanged(newer))->ci.hi, 1.0, 1e-12);
    }
  });
}

TEST(Intervals, SayNothingWhereThereIsNothingToSay) {
  const Counts none{0, 0};
  EXPECT_FALSE(efficiency(none));
  EXPECT_EQ(wilson(none).lo, 0.0);
  EXPECT_EQ(wilson(none).hi, 1.0);
  EXPECT_EQ(newcombe(none, kNew).lo, -1.0);
  EXPECT_EQ(newcombe(kOld, none).hi, 1.0);
  EXPECT_FALSE(relative_gain(none, kNew));
  EXPECT_FALSE(relative_gain({0, 5}, kNew));
  EXPECT_FALSE(relative_gain(kOld, none));
  EXPECT_FALSE(risk_ratio(kOld, {0, 5}));
  EXPECT_FALSE(risk_ratio({1, 1}, {1, 1}));
  EXPECT_FALSE(risk_ratio({5, 5}, {100, 100}));
  EXPECT_FALSE(odds_ratio(kOld, {5, 5}));
}

TEST(Intervals, TouchTheEndsExactlyWhereAllOrNoneAreInside) {
  EXPECT_EQ(wilson({0, 10}).lo, 0.0);
  EXPECT_NEAR(wilson({0, 10}).hi, 0.2775327999, 1e-9);  // z^2 / (n + z^2)
  EXPECT_EQ(wilson({10, 10}).hi, 1.0);
  EXPECT_EQ(relative_gain({1, 2}, {0, 5}), -1.0);
}

TEST(Intervals, ShrinkWithTheSquareRootOfHugeCounts) {
  const auto width = [](std::int64_t n) { return wilson({n / 2, n}).hi - wilson({n / 2, n}).lo; };
  EXPECT_NEAR(width(1'000'000'000) / width(4'000'000'000), 2.0, 1e-6);
}

TEST(Intervals, WidenWithTheConfidence) {
  EXPECT_LT(wilson(kOld, 0.8).hi, wilson(kOld, 0.95).hi);
  EXPECT_LT(wilson(kOld, 0.95).hi, wilson(kOld, 0.99).hi);
}

}  // namespace
}  // namespace trivela::evaluator::stats
