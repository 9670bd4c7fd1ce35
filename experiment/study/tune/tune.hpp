#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/study/report.hpp"
#include "experiment/study/tune/tune_space.hpp"

namespace trivela::experiment {

/// A setting that was changed for the better, on the matches that it was chosen by.
struct TuneStep {
  int round = 1;
  Choice from;
  Choice to;
  Effect gain;  ///< shots on target per opportunity
};

/// What a search looks for, on which matches, and what it has found so far.
struct Tuning {
  std::string policy;
  std::string command;  ///< that makes the file again
  StudyPlayed tuning{};
  StudyPlayed held_out{};  ///< matches that it is tried on afterwards
  std::vector<Coordinate> space{};
  config::Settings settings{};  ///< where it begins, then the best so far
  ArmTally start{};             ///< the settings that it began with, played
  ArmTally best{};              ///< `settings`, played
  std::size_t tried = 0;        ///< settings that were played
  std::vector<TuneStep> steps{};
  bool finished = false;                     ///< a whole round changed nothing, or there was no further round
  std::optional<ArmTally> held_out_start{};  ///< none: interrupted before
  std::optional<ArmTally> held_out_best{};
};

/// Plays the same matches with each of the settings.
using PlaySettings = std::function<std::vector<ArmTally>(const std::vector<config::Settings>&)>;

/// Coordinate search: each coordinate in turn is set to the choice with the most shots on target per opportunity, if
/// the 95 % interval of its gain over the present one lies above 0: what makes no difference stays. Again, until a
/// round changes nothing, `rounds` at most. `tuning` is whole after each call of `play`, so that whoever throws there
/// keeps the best so far.
void coordinate_search(int rounds, const PlaySettings& play, Tuning& tuning);

/// What was changed, the objective where it was chosen and on held-out matches, and what choosing made of it.
std::string to_text(const Tuning& tuning);

/// A file for --config: the settings that were searched and every other one of [policy] that is not the built-in
/// default, below comments that say where they come from. Its robot and scenario are named relative to `out`'s folder.
std::string to_settings_file(const Tuning& tuning, const std::filesystem::path& out);

}  // namespace trivela::experiment
