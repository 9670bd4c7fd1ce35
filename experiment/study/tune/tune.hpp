#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "experiment/study/study.hpp"
#include "kicking/policy/policy.hpp"

namespace trivela::experiment {

/// TOML lines such as `policy.settle_s = 0.1`.
using Choice = std::vector<std::string>;

/// One setting, or two that make no sense apart, with the values that are tried.
struct Coordinate {
  std::string name;             ///< key of the setting, or of the first one
  std::vector<Choice> choices;  ///< all of the same keys
};

/// What `trivela study tune` searches: config/studies/tune.csv, or of a policy from outside each of its own settings.
/// Throws std::invalid_argument for a policy without settings to choose.
std::vector<Coordinate> tuned_space(kicking::PolicyName policy);

/// Names of the policies that have some.
std::vector<std::string> tuned_policies();

/// "KEY=V1|V2|V3" as a coordinate; "KEY" alone: that of the space. Throws config::BadArgument, which calls the text
/// `called`, for a key that is no setting of [policy], a value that it cannot have, and fewer than two values.
Coordinate coordinate_of(const std::string& text, const std::vector<Coordinate>& space, const std::string& called);

/// The settings with a choice on top. Throws config::Error.
config::Settings with_choice(config::Settings settings, const Choice& choice);

/// The lines of the coordinate as the settings have them: a choice that changes nothing.
Choice present_choice(const config::Settings& settings, const Coordinate& coordinate);

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
  bool finished = false;                    ///< a whole round changed nothing, or there was no further round
  std::vector<ArmTally> held_out_played{};  ///< of the start and of the best; empty: interrupted before
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
