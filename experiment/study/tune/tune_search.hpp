#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiment/study/effects.hpp"
#include "experiment/study/tune/tune_space.hpp"

namespace trivela::experiment {

/// A setting that was changed for the better, on the matches that it was chosen by.
struct TuneStep {
  int round = 1;
  std::string from;
  std::string to;
  Effect gain;  ///< shots on target per opportunity
};

/// Where a search stands.
struct TuneState {
  config::Settings settings{};
  ArmTally start{};       ///< the settings that it began with, played
  ArmTally best{};        ///< `settings`, played
  std::size_t tried = 0;  ///< settings that were played
  std::vector<TuneStep> steps{};
  bool finished = false;  ///< a whole round changed nothing, or there was no further round
};

/// Plays the same matches with each of the settings.
using PlaySettings = std::function<std::vector<ArmTally>(const std::vector<config::Settings>&)>;

/// Coordinate search: each coordinate in turn is set to the choice with the most shots on target per opportunity, if
/// the 95 % interval of its gain over the present one lies above 0: what makes no difference stays. Again, until a
/// round changes nothing, `rounds` at most. `state.settings` is where it begins; the state is whole after each call of
/// `play`, so that whoever throws there keeps the best so far.
void coordinate_search(const std::vector<Coordinate>& space, int rounds, const PlaySettings& play, TuneState& state);

}  // namespace trivela::experiment
