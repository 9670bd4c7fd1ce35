#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "evaluator/stats/counts/interval.hpp"
#include "tests/evaluator/random_numbers.hpp"

namespace trivela::evaluator::stats {

// How often a 95 % interval holds the truth: 1,000 seeded repetitions of a simulated experiment each.
inline constexpr int kRepetitions = 1000;

// Of 1,000 repetitions a coverage of 0.95 is met 929 to 969 times with 99.7 % probability (binomial).
inline constexpr double kLow = 0.929, kHigh = 0.969;

template <typename Experiment>
double coverage(double truth, Experiment experiment) {
  int held = 0;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    RandomNumbers random(static_cast<std::uint64_t>(1000 + repetition));
    const std::optional<Interval> ci = experiment(random);
    held += ci && ci->lo <= truth && truth <= ci->hi ? 1 : 0;
  }
  const double share = static_cast<double>(held) / kRepetitions;
  testing::Test::RecordProperty("coverage", std::to_string(share));
  return share;
}

#define EXPECT_NOMINAL(share)     \
  do {                            \
    const double value = (share); \
    EXPECT_GE(value, kLow);       \
    EXPECT_LE(value, kHigh);      \
  } while (false)

// An interval that is wide on purpose.
#define EXPECT_CONSERVATIVE(share) EXPECT_GE(share, 0.94)

}  // namespace trivela::evaluator::stats
