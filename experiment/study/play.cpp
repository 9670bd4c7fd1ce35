#include "experiment/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "config/scenario/scenario.hpp"
#include "experiment/play/play_match.hpp"
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
  return fmt::format("seed = {}\npossessions = {}\n\n### scenario\n{}\n### arm\n{}{}", plan.seed, plan.possessions,
                     config::to_toml_text(scenario), describe(arm), arm.own_robots ? "" : describe(plan.calibrations));
}

/// An arm of a world, and its place in the results.
struct Place {
  const StudyWorld& world;
  std::size_t arm;
  std::string kept;
};

}  // namespace

KnownPlay play_missing(const std::vector<StudyWorld>& worlds, const PlayPlan& plan, log::StudyResults& results,
                       const std::function<void(std::size_t, std::size_t, const std::string&)>& progress) {
  const log::MatchRange range = plan.range();
  std::vector<Place> places;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> missing;  // place and match
  for (const StudyWorld& world : worlds) {
    std::vector<std::uint32_t> first;  // of the results' arms, one may be there twice
    for (std::size_t i = 0; i < world.arms.size(); ++i) {
      const std::string kept = log::StudyResults::arm(text_of(world.scenario, world.arms[i], plan));
      if (std::ranges::find(places, kept, &Place::kept) == places.end())
        first.push_back(static_cast<std::uint32_t>(places.size()));
      places.push_back({world, i, kept});
    }
    for (std::uint32_t match = range.begin; match < range.end; ++match)  // slow arms are spread over the threads
      for (const std::uint32_t place : first)
        if (!results.matches_of(places[place].kept).contains(match)) missing.emplace_back(place, match);
  }
  std::size_t done = 0;
  progress(done, missing.size(), worlds.front().what);
  std::mutex one_at_a_time;
  bool stopped = false;  // by an exception: matches that were under way are not reported
  in_threads(missing.size(), plan.jobs, [&](std::size_t i) {
    const auto match = missing[i].second;
    const Place& place = places[missing[i].first];
    const Arm arm = plan.in_match(match, place.world.arms[place.arm]);
    const MatchTally tally =
        tally_of(play_match(place.world.scenario, arm, plan.seed, match, plan.possessions), plan.calibration_of(match));
    const std::lock_guard lock{one_at_a_time};
    if (std::exchange(stopped, true)) return;
    results.add(place.kept, match, tally);
    progress(++done, missing.size(), place.world.what);
    stopped = false;
  });
  KnownPlay play{.rows = {}, .whole = true};
  for (const Place& place : places) {
    const auto& known = results.matches_of(place.kept);
    const auto& labels = place.world.labels;
    play.rows.push_back({labels.empty() ? RowLabels{} : labels[place.arm], ArmTally(plan.matches)});
    for (const auto& [match, tally] : known) play.rows.back().matches.at(match) = tally;
    play.whole = play.whole && known.size() == plan.matches;
  }
  return play;
}

}  // namespace trivela::experiment
