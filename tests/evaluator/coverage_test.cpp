// How often a 95 % interval holds the truth: 1,000 seeded repetitions of a simulated experiment each.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "evaluator/stats/bayes.hpp"
#include "evaluator/stats/counts/exact.hpp"
#include "evaluator/stats/counts/interval.hpp"
#include "evaluator/stats/counts/strata.hpp"
#include "evaluator/stats/off_policy.hpp"
#include "evaluator/stats/paired.hpp"
#include "tests/evaluator/coverage.hpp"

namespace trivela::evaluator::stats {
namespace {

TEST(Coverage, Wilson) {
  EXPECT_NOMINAL(coverage(0.62, [](auto& random) { return wilson(random.kicks(65, 0.62)); }));
  EXPECT_NOMINAL(coverage(0.9, [](auto& random) { return wilson(random.kicks(132, 0.9)); }));
}

TEST(Coverage, ClopperPearsonIsConservative) {
  EXPECT_CONSERVATIVE(coverage(0.62, [](auto& random) { return clopper_pearson(random.kicks(40, 0.62)); }));
}

TEST(Coverage, NewcombeAndAgrestiCaffo) {
  EXPECT_NOMINAL(
      coverage(0.24, [](auto& random) { return newcombe(random.kicks(65, 0.52), random.kicks(132, 0.76)); }));
  EXPECT_NOMINAL(
      coverage(0.3, [](auto& random) { return agresti_caffo(random.kicks(14, 0.4), random.kicks(12, 0.7)); }));
}

TEST(Coverage, RatiosOfProportions) {
  EXPECT_NOMINAL(coverage(0.76 / 0.52, [](auto& random) -> std::optional<Interval> {
    return risk_ratio(random.kicks(65, 0.52), random.kicks(132, 0.76))->ci;
  }));
  EXPECT_NOMINAL(coverage(0.76 / 0.24 / (0.52 / 0.48), [](auto& random) -> std::optional<Interval> {
    return odds_ratio(random.kicks(65, 0.52), random.kicks(132, 0.76))->ci;
  }));
}

PairedCounts paired_opportunities(RandomNumbers& random, int n) {
  PairedCounts pairs;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    (u < 0.40 ? pairs.both : u < 0.65 ? pairs.newer_only : u < 0.75 ? pairs.older_only : pairs.neither) += 1;
  }
  return pairs;
}

TEST(Coverage, PairedNewcombe) {
  EXPECT_NOMINAL(coverage(0.15, [](auto& random) { return paired_newcombe(paired_opportunities(random, 80)); }));
}

TEST(Coverage, PosteriorOfTheDifference) {
  // The central interval holds the truth where as much as a 40th lies on either side; cheaper than its two ends.
  EXPECT_NOMINAL(coverage(0.0, [](auto& random) -> std::optional<Interval> {
    const double above = p_new_better(random.kicks(65, 0.52), random.kicks(132, 0.76), 0.24);
    return Interval{0.025 - above, 0.975 - above};
  }));
}

// Three distances with the same odds ratio of 2.
constexpr std::array kBase{0.8, 0.5, 0.25};
constexpr std::array<std::int64_t, 3> kOlder{40, 30, 20}, kNewer{20, 40, 70};

double with_odds(double p, double ratio) { return ratio * p / (1.0 - p + ratio * p); }

std::vector<Stratum> three_distances(RandomNumbers& random) {
  std::vector<Stratum> strata;
  for (std::size_t i = 0; i < kBase.size(); ++i) {
    const Counts older = random.kicks(kOlder[i], kBase[i]);
    strata.push_back({older, random.kicks(kNewer[i], with_odds(kBase[i], 2.0))});
  }
  return strata;
}

TEST(Coverage, MantelHaenszelOddsRatio) {
  EXPECT_NOMINAL(coverage(2.0, [](auto& random) -> std::optional<Interval> {
    return mantel_haenszel_odds_ratio(three_distances(random))->ci;
  }));
}

TEST(Coverage, MantelHaenszelRiskDifference) {
  double weighted = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < kBase.size(); ++i) {
    const double w = static_cast<double>(kOlder[i] * kNewer[i]) / static_cast<double>(kOlder[i] + kNewer[i]);
    weighted += w * (with_odds(kBase[i], 2.0) - kBase[i]);
    weights += w;
  }
  EXPECT_NOMINAL(coverage(weighted / weights, [](auto& random) -> std::optional<Interval> {
    return mantel_haenszel_risk_difference(three_distances(random))->ci;
  }));
}

TEST(Coverage, StandardisedDifference) {
  double truth = 0.0;
  for (std::size_t i = 0; i < kBase.size(); ++i) {
    truth += static_cast<double>(kOlder[i] + kNewer[i]) / 220.0 * (with_odds(kBase[i], 2.0) - kBase[i]);
  }
  EXPECT_NOMINAL(coverage(truth, [](auto& random) -> std::optional<Interval> {
    return standardised(three_distances(random))->difference.ci;
  }));
}

// A bandit with known truth: the logging policy explores with 10 %, the valued one is the rarer, and what helps depends
// on the distance.
constexpr double kExplored = 0.3;

double bandit_reward(double distance, bool target) { return target ? 0.8 - 0.08 * distance : 0.6 - 0.05 * distance; }

std::vector<Trial> bandit(RandomNumbers& random) {
  std::vector<Trial> trials;
  for (std::uint32_t match = 0; match < 20; ++match) {
    for (int i = 0; i < 40; ++i) {
      const double distance = 2.0 + 4.0 * random.uniform();
      // Near kicks are given to the target more often, so that the plain mean of its kicks is too good.
      const double p_target = distance < 4.0 ? kExplored : 0.1;
      const bool target = random.happens(p_target);
      trials.push_back({.by_target = target,
                        .probability = target ? p_target : 1.0 - p_target,
                        .reward = random.happens(bandit_reward(distance, target)) ? 1.0 : 0.0,
                        .match = match,
                        .context = {distance, random.normal(), 1.0, 0.0}});
    }
  }
  return trials;
}

constexpr double kBanditTruth = 0.8 - 0.08 * 4.0;

TEST(Coverage, OffPolicyEstimates) {
  double naive = 0.0, ips = 0.0, snips = 0.0, robust = 0.0;
  int held_ips = 0, held_snips = 0, held_robust = 0;
  const auto holds = [](const PolicyValue& value) {
    return value.ci.lo <= kBanditTruth && kBanditTruth <= value.ci.hi;
  };
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    RandomNumbers random(static_cast<std::uint64_t>(5000 + repetition));
    const auto trials = bandit(random);
    const OffPolicy result = off_policy_value(trials);
    double rewards = 0.0;
    for (const Trial& trial : trials) rewards += trial.by_target ? trial.reward : 0.0;
    naive += rewards / static_cast<double>(result.by_target) / kRepetitions;
    ips += result.ips.value / kRepetitions;
    snips += result.snips.value / kRepetitions;
    robust += result.doubly_robust.value / kRepetitions;
    held_ips += holds(result.ips) ? 1 : 0;
    held_snips += holds(result.snips) ? 1 : 0;
    held_robust += holds(result.doubly_robust) ? 1 : 0;
  }
  EXPECT_NEAR(ips, kBanditTruth, 0.006);
  EXPECT_NEAR(snips, kBanditTruth, 0.006);
  EXPECT_NEAR(robust, kBanditTruth, 0.006);
  EXPECT_GT(naive, kBanditTruth + 0.03) << "the mean of its own kicks favours a policy that is given the easy ones";
  EXPECT_NOMINAL(held_ips / 1000.0);
  EXPECT_NOMINAL(held_snips / 1000.0);
  EXPECT_NOMINAL(held_robust / 1000.0);
}

}  // namespace
}  // namespace trivela::evaluator::stats
