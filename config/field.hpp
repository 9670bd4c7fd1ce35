#pragma once

#include <filesystem>

#include "config/settings.hpp"
#include "kicking/policy/match_rules.hpp"

/// Goal, field and rules stand in a file of their own (config/fields/NAME.toml: [field] and [rules] as a scenario has
/// them), which the settings of nodes name by run.field_file and scenarios by field_file. Nodes that play a scenario
/// take the scenario's.
namespace trivela::config {

/// What such a file says.
struct FieldFile {
  kicking::PlayingField field;
  kicking::MatchRules rules;
};

/// Reads it; what it does not name keeps the default of the paper's field. Throws Error.
FieldFile load_field(const std::filesystem::path& path);

/// Settings of nodes on this field, by these rules.
Settings on_field(const FieldFile& field, Settings settings);

}  // namespace trivela::config
