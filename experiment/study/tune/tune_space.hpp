#pragma once

#include <string>
#include <vector>

#include "config/settings.hpp"
#include "kicking/policy/policy.hpp"

namespace trivela::experiment {

/// One setting, or two that make no sense apart, with the values that are tried.
struct Coordinate {
  std::string name;                  ///< key of the setting, or of the first one
  std::vector<std::string> choices;  ///< each TOML lines such as `policy.settle_s = 0.1`, of the same keys
};

/// The parts of a text between these characters; without a last one that is empty.
std::vector<std::string> split(const std::string& text, char at);

/// What `trivela tune` searches: the settings of a policy that are its own choice. Limits of the robot (speeds,
/// accelerations), what is safe (ages of states and orders) and the goal's size are no choice. Throws
/// std::invalid_argument for a policy without settings to choose.
std::vector<Coordinate> tuned_space(kicking::PolicyName policy);

/// Names of the policies that have some.
std::vector<std::string> tuned_policies();

/// "KEY=V1|V2|V3" as a coordinate; "KEY" alone: that of the space. Throws config::BadArgument, which calls the text
/// `called`, for a key that is no setting of [policy], a value that it cannot have, and fewer than two values.
Coordinate coordinate_of(const std::string& text, const std::vector<Coordinate>& space,
                         const std::string& called = "setting");

/// The settings with a choice on top. Throws config::Error.
config::Settings with_choice(config::Settings settings, const std::string& choice);

/// The lines of the coordinate as the settings have them: a choice that changes nothing.
std::string present_choice(const config::Settings& settings, const Coordinate& coordinate);

}  // namespace trivela::experiment
