#pragma once

#include <optional>
#include <string>

#include "config/settings.hpp"
#include "sim/scenario.hpp"

namespace trivela::config {

/// Settings of nodes that play in this scenario: its goal, its field, its rules; whatever file they came from.
Settings on_field_of(const sim::Scenario& scenario, Settings settings);

/// In words, the first key of [goal] and [rules] in which settings and scenario differ. None: they agree.
std::optional<std::string> field_difference(const sim::Scenario& scenario, const Settings& settings);

/// The same of what the settings do not merely have by default, or have by a field file: on_field_of() would overrule
/// somebody's word.
std::optional<std::string> field_contradiction(const sim::Scenario& scenario, const Settings& settings);

}  // namespace trivela::config
