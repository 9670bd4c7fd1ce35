// Robots that find out how the keeper plays, in simulated matches.
#include <gtest/gtest.h>

#include "experiment/play/play_match.hpp"

namespace trivela::experiment {
namespace {

struct Tally {
  int kicks = 0, on_target = 0, goals = 0;
  bool operator==(const Tally&) const = default;
};

/// 40 matches of 20 possessions.
Tally play(const sim::Scenario& scenario, double guess_prior) {
  Arm arm;
  arm.policy = kicking::PolicyName::kPredictive;
  arm.settings.policy.keeper.guess_prior = guess_prior;
  Tally tally;
  for (std::uint32_t match = 0; match < 40; ++match) {
    for (const PlayedPossession& possession : play_match(scenario, arm, 3, match, 20).possessions) {
      if (!possession.kick) continue;
      ++tally.kicks;
      tally.on_target += possession.kick->truth == kicking::Outcome::kOnTarget;
      tally.goals += possession.kick->truth == kicking::Outcome::kOnTarget && !possession.kick->truth_saved;
    }
  }
  return tally;
}

sim::Scenario with_keeper(double guess_m) {
  sim::Scenario scenario;
  scenario.keeper.enabled = true;
  scenario.keeper.guess_m = guess_m;
  return scenario;
}

TEST(KeeperHabitInPlay, PastAKeeperThatGuessesItWinsGoals) {
  const Tally without = play(with_keeper(0.6), 0.0), with = play(with_keeper(0.6), 0.1);
  EXPECT_GT(with.goals, 1.3 * without.goals);
  EXPECT_GT(with.on_target, without.on_target);
}

TEST(KeeperHabitInPlay, PastAKeeperThatWaitsItChangesNoKick) {
  EXPECT_EQ(play(with_keeper(0.0), 0.1), play(with_keeper(0.0), 0.0));
}

TEST(KeeperHabitInPlay, WithoutAKeeperItChangesNoKick) { EXPECT_EQ(play({}, 0.1), play({}, 0.0)); }

}  // namespace
}  // namespace trivela::experiment
