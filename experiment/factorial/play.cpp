#include "experiment/factorial/play.hpp"

#include "experiment/play/play_match.hpp"
#include "experiment/run/in_threads.hpp"

namespace trivela::experiment {
namespace {

MatchTally tally_of(const PlayedMatch& match, std::uint32_t evening) {
  MatchTally tally{.calibration = evening};
  for (const PlayedPossession& possession : match.possessions) {
    ++tally.opportunities;
    if (!possession.kick) continue;
    const PlayedKick& kick = *possession.kick;
    const bool on_target = kick.observed == kicking::Outcome::kOnTarget;
    ++tally.kicks;
    tally.on_target += on_target ? 1 : 0;
    tally.blocked += kick.observed == kicking::Outcome::kBlocked ? 1 : 0;
    tally.bounced += on_target && kick.truth_bounced ? 1 : 0;
    tally.goals += kick.truth == kicking::Outcome::kOnTarget && !kick.truth_saved ? 1 : 0;
  }
  return tally;
}

}  // namespace

std::vector<std::vector<MatchTally>> play_arms(const sim::Scenario& scenario, const std::vector<Arm>& arms,
                                               const PlayPlan& plan,
                                               const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<std::vector<MatchTally>> tallies(arms.size(), std::vector<MatchTally>(plan.matches));
  const EveningArms by_evening{arms, plan.evenings};
  // Match by match, so that slow arms are spread over the threads.
  const auto play = [&](std::size_t i) {
    const std::size_t arm = i % arms.size();
    const auto match = static_cast<std::uint32_t>(i / arms.size());
    tallies[arm][match] = tally_of(play_match(scenario, by_evening.of(match)[arm], plan.seed, match, plan.possessions),
                                   by_evening.evening_of(match));
  };
  in_threads(arms.size() * plan.matches, plan.jobs, play, progress);
  return tallies;
}

}  // namespace trivela::experiment
