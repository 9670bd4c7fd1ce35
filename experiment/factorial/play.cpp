#include "experiment/factorial/play.hpp"

#include <mutex>
#include <utility>

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
    tally.true_on_target += kick.truth == kicking::Outcome::kOnTarget ? 1 : 0;
    tally.goals += kick.truth == kicking::Outcome::kOnTarget && !kick.truth_saved ? 1 : 0;
  }
  return tally;
}

}  // namespace

void play_matches(const sim::Scenario& scenario, const std::vector<Arm>& arms, const PlayPlan& plan,
                  const std::vector<ArmMatch>& matches,
                  const std::function<void(const ArmMatch&, const MatchTally&)>& played) {
  const EveningArms by_evening{arms, plan.evenings};
  std::mutex one_at_a_time;
  bool stopped = false;  // by an exception of `played`: matches that were under way are not reported
  in_threads(matches.size(), plan.jobs, [&](std::size_t i) {
    const auto& [arm, match] = matches[i];
    const MatchTally tally =
        tally_of(play_match(scenario, by_evening.of(match)[arm], plan.seed, match, plan.possessions),
                 by_evening.evening_of(match));
    const std::lock_guard lock{one_at_a_time};
    if (std::exchange(stopped, true)) return;
    played(matches[i], tally);
    stopped = false;
  });
}

std::vector<std::vector<MatchTally>> play_arms(const sim::Scenario& scenario, const std::vector<Arm>& arms,
                                               const PlayPlan& plan,
                                               const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<std::vector<MatchTally>> tallies(arms.size(), std::vector<MatchTally>(plan.matches));
  std::vector<ArmMatch> matches;  // match by match, so that slow arms are spread over the threads
  for (std::uint32_t match = 0; match < plan.matches; ++match)
    for (std::size_t arm = 0; arm < arms.size(); ++arm) matches.push_back({arm, match});
  std::size_t done = 0;
  play_matches(scenario, arms, plan, matches, [&](const ArmMatch& at, const MatchTally& tally) {
    tallies[at.arm][at.match] = tally;
    progress(++done, matches.size());
  });
  return tallies;
}

}  // namespace trivela::experiment
