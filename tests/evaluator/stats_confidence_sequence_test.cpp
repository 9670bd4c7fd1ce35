#include "evaluator/stats/confidence_sequence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "evaluator/stats/counts/interval.hpp"
#include "tests/evaluator/random_numbers.hpp"

namespace trivela::evaluator::stats {
namespace {

constexpr int kSequences = 1000;
constexpr int kMostFalseAlarms = 50;  // 5 %

struct ProportionCase {
  Counts counts;
  Interval interval;
};

TEST(ConfidenceSequence, IsThatOfAnIndependentComputation) {
  // In Python with math.lgamma and 200 halvings: where lgamma(k + 1) + lgamma(n - k + 1) - lgamma(n + 2)
  // - k log p - (n - k) log(1 - p) is log 20.
  const ProportionCase cases[] = {{{0, 1}, {0.0, 0.9750000000}},
                                  {{1, 1}, {0.0250000000, 1.0}},
                                  {{0, 10}, {0.0, 0.4168802757}},
                                  {{5, 10}, {0.1292190124, 0.8707809876}},
                                  {{33, 39}, {0.6172887377, 0.9677199801}},
                                  {{47, 66}, {0.5217775797, 0.8617715307}},
                                  {{700, 1000}, {0.6469848008, 0.7496620474}}};
  for (const auto& [counts, expected] : cases) {
    const Interval interval = confidence_sequence(counts);
    EXPECT_NEAR(interval.lo, expected.lo, 1e-9) << counts.inside << " of " << counts.n;
    EXPECT_NEAR(interval.hi, expected.hi, 1e-9) << counts.inside << " of " << counts.n;
  }
}

TEST(ConfidenceSequence, KnowsNothingOfNoKick) {
  EXPECT_EQ(confidence_sequence({}).lo, 0.0);
  EXPECT_EQ(confidence_sequence({}).hi, 1.0);
  EXPECT_EQ(difference_sequence({}, {3, 4}).lo, -1.0);
  EXPECT_EQ(difference_sequence({3, 4}, {}).hi, 1.0);
  EXPECT_EQ(always_valid_p({}, {}), 1.0);
}

TEST(ConfidenceSequence, IsWiderThanAnIntervalOfOneLook) {
  for (const Counts counts : {Counts{3, 10}, {33, 39}, {500, 1000}}) {
    EXPECT_LT(confidence_sequence(counts).lo, wilson(counts).lo);
    EXPECT_GT(confidence_sequence(counts).hi, wilson(counts).hi);
  }
}

TEST(DifferenceSequence, IsThatOfAnIndependentComputation) {
  // In Python: 300 thirds over the older group's proportion within 60 halvings over the difference.
  const std::tuple<Counts, Counts, Interval, double> cases[] = {
      {{18, 39}, {33, 39}, {0.002569354, 0.698709506}, 3.0806087373},
      {{5, 10}, {5, 10}, {-0.626663307, 0.626663307}, -1.9917051094},
      {{0, 3}, {3, 3}, {-0.235275509, 1.0}, 1.3862943611},
      {{0, 30}, {30, 30}, {0.696813481, 1.0}, 34.7208564246},
      {{500, 1000}, {620, 1000}, {0.023509627, 0.215021250}, 8.1609794467}};
  for (const auto& [older, newer, expected, log_evidence] : cases) {
    const Interval interval = difference_sequence(older, newer);
    EXPECT_NEAR(interval.lo, expected.lo, 1e-6) << older.inside << ", " << newer.inside;
    EXPECT_NEAR(interval.hi, expected.hi, 1e-6) << older.inside << ", " << newer.inside;
    EXPECT_NEAR(log_evidence_against(0.0, older, newer), log_evidence, 1e-8);
  }
}

TEST(DifferenceSequence, TurnsWithItsGroups) {
  const Interval there = difference_sequence({12, 20}, {17, 21});
  const Interval back = difference_sequence({17, 21}, {12, 20});
  EXPECT_NEAR(there.lo, -back.hi, 1e-9);
  EXPECT_NEAR(there.hi, -back.lo, 1e-9);
}

TEST(DifferenceSequence, HoldsNoDifferenceWhereItsPIsAboveFivePercent) {
  for (std::int64_t inside = 0; inside <= 20; ++inside) {
    const Counts older{6, 20}, newer{inside, 20};
    const Interval interval = difference_sequence(older, newer);
    EXPECT_EQ(interval.lo <= 0.0 && 0.0 <= interval.hi, always_valid_p(older, newer) > 0.05) << inside;
  }
}

/// How many of the sequences ever leave the true proportion out, with a look after every kick.
template <typename Holds>
int false_alarms(double p, int kicks, std::uint64_t seed, const Holds& holds) {
  int alarms = 0;
  for (int sequence = 0; sequence < kSequences; ++sequence) {
    RandomNumbers random{seed + static_cast<std::uint64_t>(sequence)};
    Counts counts;
    bool alarm = false;
    for (int kick = 0; kick < kicks && !alarm; ++kick) {
      ++counts.n;
      if (random.happens(p)) ++counts.inside;
      alarm = !holds(counts, p);
    }
    alarms += alarm ? 1 : 0;
  }
  return alarms;
}

bool within(const Interval& interval, double value) { return interval.lo <= value && value <= interval.hi; }

TEST(Peeking, AfterEveryKickOfAThousandSequencesStaysBelowFivePercent) {
  std::map<std::pair<std::int64_t, std::int64_t>, Interval> known;
  const auto holds = [&](Counts counts, double p) {
    const auto [place, fresh] = known.try_emplace({counts.inside, counts.n});
    if (fresh) place->second = confidence_sequence(counts);
    return within(place->second, p);
  };
  for (const double p : {0.3, 0.5, 0.7, 0.95}) EXPECT_LT(false_alarms(p, 200, 20'001, holds), kMostFalseAlarms) << p;
}

TEST(Peeking, MakesWilsonsIntervalWrongFarMoreOften) {
  const auto holds = [](Counts counts, double p) { return within(wilson(counts), p); };
  EXPECT_GT(false_alarms(0.7, 200, 20'001, holds), 3 * kMostFalseAlarms);
}

TEST(Peeking, AtTheDifferenceOfTwoPoliciesThatAreAlikeStaysBelowFivePercent) {
  for (const double p : {0.3, 0.7}) {
    int alarms = 0;
    for (int sequence = 0; sequence < kSequences; ++sequence) {
      RandomNumbers random{30'001 + static_cast<std::uint64_t>(sequence)};
      Counts groups[2];
      bool alarm = false;
      for (int kick = 0; kick < 200 && !alarm; ++kick) {
        Counts& drawn = groups[random.happens(0.5) ? 1 : 0];
        ++drawn.n;
        if (random.happens(p)) ++drawn.inside;
        alarm = always_valid_p(groups[0], groups[1]) < 0.05;
      }
      alarms += alarm ? 1 : 0;
    }
    EXPECT_LT(alarms, kMostFalseAlarms) << p;
  }
}

TEST(Peeking, FindsALargeDifferenceInTime) {
  int found = 0;
  for (int sequence = 0; sequence < 100; ++sequence) {
    RandomNumbers random{40'001 + static_cast<std::uint64_t>(sequence)};
    const Counts older = random.kicks(100, 0.45), newer = random.kicks(100, 0.85);
    if (difference_sequence(older, newer).lo > 0.0) ++found;
  }
  EXPECT_GT(found, 95);
}

}  // namespace
}  // namespace trivela::evaluator::stats
