#pragma once

#include <string>
#include <vector>

#include "config/settings.hpp"
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

/// The keys that its choices set.
std::vector<std::string> keys_of(const Coordinate& coordinate);

/// The settings with a choice on top. Throws config::Error.
config::Settings with_choice(config::Settings settings, const Choice& choice);

/// The lines of the coordinate as the settings have them: a choice that changes nothing.
Choice present_choice(const config::Settings& settings, const Coordinate& coordinate);

}  // namespace trivela::experiment
