#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "config/settings.hpp"
#include "sim/scenario.hpp"

/// Goal, field and rules stand in a file of their own (config/fields/NAME.toml: [field] and [rules] as a scenario has
/// them), which the settings of nodes name by run.field_file and scenarios by field_file. Nodes that play a scenario
/// take the scenario's.
namespace trivela::config {

/// What such a file says.
struct FieldFile {
  sim::Field field;
  kicking::MatchRules rules;
};

/// Reads it; what it does not name keeps the default of the paper's field. Throws Error.
FieldFile load_field(const std::filesystem::path& path);

/// Settings of nodes on this field, by these rules.
Settings on_field(const FieldFile& field, Settings settings);

/// Settings of nodes that play in this scenario: its goal, its field, its rules; whatever file they came from.
Settings on_field_of(const sim::Scenario& scenario, Settings settings);

/// In words, the first key of [goal] and [rules] in which settings and scenario differ. None: they agree.
std::optional<std::string> field_difference(const sim::Scenario& scenario, const Settings& settings);

/// The same of what the settings do not merely have by default, or have by a field file: on_field_of() would overrule
/// somebody's word.
std::optional<std::string> field_contradiction(const sim::Scenario& scenario, const Settings& settings);

}  // namespace trivela::config
