#include "experiment/study/tune/tune_search.hpp"

#include <algorithm>

namespace trivela::experiment {
namespace {

Effect gain_of(const ArmTally& tried, const ArmTally& present) {
  const Term terms[] = {{&tried, 1.0}, {&present, -1.0}};
  return contrast(terms, Measure::kPerOpportunity);
}

bool is_told_apart(const Effect& gain) { return (has_interval(gain) ? gain.ci.lo : gain.value) > 0.0; }

/// Sets one coordinate; true: to something else than before.
bool improve(const Coordinate& coordinate, int round, const PlaySettings& play, TuneState& state) {
  const std::string present = present_choice(state.settings, coordinate);
  const auto before = config::setting_values(state.settings);
  std::vector<std::string> choices;
  std::vector<config::Settings> candidates;
  for (const std::string& choice : coordinate.choices) {
    config::Settings candidate = with_choice(state.settings, choice);
    if (config::setting_values(candidate) == before) continue;
    choices.push_back(choice);
    candidates.push_back(std::move(candidate));
  }
  if (candidates.empty()) return false;
  std::vector<ArmTally> played = play(candidates);
  state.tried += candidates.size();
  const auto best = std::ranges::max_element(played, {}, [](const ArmTally& arm) { return total_of(arm).on_target; });
  const auto i = static_cast<std::size_t>(best - played.begin());
  const Effect gain = gain_of(*best, state.best);
  if (!is_told_apart(gain)) return false;
  state.steps.push_back({round, present, present_choice(candidates[i], coordinate), gain});
  state.settings = std::move(candidates[i]);
  state.best = std::move(*best);
  return true;
}

}  // namespace

void coordinate_search(const std::vector<Coordinate>& space, int rounds, const PlaySettings& play, TuneState& state) {
  state.start = state.best = play({state.settings}).front();
  ++state.tried;
  for (int round = 1; round <= rounds; ++round) {
    bool changed = false;
    for (const Coordinate& coordinate : space) changed = improve(coordinate, round, play, state) || changed;
    if (!changed) break;
  }
  state.finished = true;
}

}  // namespace trivela::experiment
