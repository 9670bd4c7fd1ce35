#include "experiment/study/play.hpp"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <utility>

#include "config/robot.hpp"
#include "config/scenario/scenario.hpp"
#include "experiment/play/play_match.hpp"
#include "experiment/run/arms.hpp"
#include "experiment/run/in_threads.hpp"

namespace trivela::experiment {
namespace {

MatchTally tally_of(const PlayedMatch& match, std::uint32_t calibration) {
  MatchTally tally{.calibration = calibration};
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

/// All that the matches of an arm depend on but their number.
std::string text_of(const sim::Scenario& scenario, const Arm& arm, const PlayPlan& plan) {
  std::string text = fmt::format("seed = {}\npossessions = {}\n\n### scenario\n{}\n### arm\n{}", plan.seed,
                                 plan.possessions, config::to_toml_text(scenario), describe(arm));
  if (arm.own_robots) return text;
  for (std::size_t k = 0; k < plan.calibrations.size(); ++k) {
    text += fmt::format("\n### calibration {}\n", k);
    for (const config::Robot& robot : plan.calibrations[k]) text += config::to_toml_text(robot);
  }
  return text;
}

}  // namespace

KnownPlay play_missing(const sim::Scenario& scenario, const std::vector<Arm>& arms, const PlayPlan& plan,
                       const std::string& what, const log::MatchRange& range, log::StudyResults& results,
                       const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<std::int64_t> ids;
  std::map<std::int64_t, std::map<std::uint32_t, MatchTally>> known;
  std::map<std::int64_t, std::size_t> first;  // arm of each id
  for (std::size_t i = 0; i < arms.size(); ++i) {
    ids.push_back(results.arm(text_of(scenario, arms[i], plan), what + ": " + arms[i].name));
    if (first.try_emplace(ids.back(), i).second) known[ids.back()] = results.matches_of(ids.back());
  }
  std::vector<std::pair<std::size_t, std::uint32_t>> missing;  // match by match: slow arms are spread over the threads
  for (std::uint32_t match = range.begin; match < range.end; ++match) {
    for (const auto& [id, arm] : first) {
      if (!known[id].contains(match)) missing.emplace_back(arm, match);
    }
  }
  std::size_t done = 0;
  progress(done, missing.size());
  const CalibratedArms calibrated{arms, plan.calibrations};
  std::mutex one_at_a_time;
  bool stopped = false;  // by an exception: matches that were under way are not reported
  in_threads(missing.size(), plan.jobs, [&](std::size_t i) {
    const auto [arm, match] = missing[i];
    const MatchTally tally =
        tally_of(play_match(scenario, calibrated.of(match)[arm], plan.seed, match, plan.possessions),
                 calibrated.calibration_of(match));
    const std::lock_guard lock{one_at_a_time};
    if (std::exchange(stopped, true)) return;
    results.add(ids[arm], match, tally);
    known[ids[arm]][match] = tally;
    progress(++done, missing.size());
    stopped = false;
  });
  KnownPlay play{.arms = std::vector<ArmTally>(arms.size(), ArmTally(plan.matches)), .whole = true};
  for (std::size_t i = 0; i < arms.size(); ++i) {
    for (const auto& [match, tally] : known[ids[i]]) play.arms[i].at(match) = tally;
    play.whole = play.whole && known[ids[i]].size() == plan.matches;
  }
  return play;
}

}  // namespace trivela::experiment
