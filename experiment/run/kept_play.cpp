#include "experiment/run/kept_play.hpp"

#include <fmt/format.h>

#include <map>

#include "config/robot.hpp"
#include "config/scenario/scenario.hpp"
#include "experiment/effects/summary.hpp"
#include "experiment/run/arms.hpp"

namespace trivela::experiment {
namespace {

using evaluator::log::MatchCounts;

MatchCounts counts_of(const MatchTally& tally) {
  return {tally.calibration, tally.opportunities, tally.kicks, tally.on_target,
          tally.blocked,     tally.bounced,       tally.goals, tally.true_on_target};
}

}  // namespace

std::string arm_text(const sim::Scenario& scenario, const Arm& arm, const PlayPlan& plan) {
  std::string text = fmt::format("seed = {}\npossessions = {}\n\n### scenario\n{}\n### arm\n{}", plan.seed,
                                 plan.possessions, config::to_toml_text(scenario), describe(arm));
  if (arm.own_robots) return text;
  for (std::size_t k = 0; k < plan.evenings.size(); ++k) {
    text += fmt::format("\n### evening {} of calibration\n", k);
    for (const config::Robot& robot : plan.evenings[k]) text += config::to_toml_text(robot);
  }
  return text;
}

KeptPlay play_kept(const sim::Scenario& scenario, const std::vector<Arm>& arms, const PlayPlan& plan,
                   const std::string& what, const evaluator::log::MatchRange& range, evaluator::log::TallyBook& book,
                   const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<std::int64_t> ids;
  std::map<std::int64_t, std::map<std::uint32_t, MatchCounts>> known;
  std::map<std::int64_t, std::size_t> first;  // arm of each id
  for (std::size_t i = 0; i < arms.size(); ++i) {
    ids.push_back(
        book.arm(arm_text(scenario, arms[i], plan), what.empty() ? arms[i].name : what + ": " + arms[i].name));
    if (first.try_emplace(ids.back(), i).second) known[ids.back()] = book.matches_of(ids.back());
  }
  std::vector<ArmMatch> missing;  // match by match, so that slow arms are spread over the threads
  for (std::uint32_t match = range.begin; match < range.end; ++match) {
    for (const auto& [id, arm] : first) {
      if (!known[id].contains(match)) missing.push_back({arm, match});
    }
  }
  std::size_t done = 0;
  progress(done, missing.size());
  play_matches(scenario, arms, plan, missing, [&](const ArmMatch& at, const MatchTally& tally) {
    book.add(ids[at.arm], at.match, counts_of(tally));
    known[ids[at.arm]][at.match] = counts_of(tally);
    progress(++done, missing.size());
  });
  KeptPlay kept{.arms = std::vector<ArmTally>(arms.size(), ArmTally(plan.matches)), .whole = true};
  for (std::size_t i = 0; i < arms.size(); ++i) {
    for (const auto& [match, counts] : known[ids[i]]) kept.arms[i].at(match) = tally_of(counts);
    kept.whole = kept.whole && known[ids[i]].size() == plan.matches;
  }
  return kept;
}

}  // namespace trivela::experiment
