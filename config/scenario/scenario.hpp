#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "sim/scenario.hpp"

namespace trivela::config {

/// Reads config/scenarios/NAME.toml; what it does not name keeps the default of sim::Scenario. Where it names a
/// field_file, relative to its own folder, [field] and [rules] are that file's (config/field.hpp). Throws Error.
sim::Scenario load_scenario(const std::filesystem::path& path);

/// Sets what a line of TOML names, e.g. "keeper.reaction_s = 0.15". Throws Error naming the line's key and value
/// after what the line is `called`; also where the scenario could no longer be played.
void override_scenario(sim::Scenario& scenario, const std::string& line, const std::string& called = "scenario");

/// Length of a half: the settings', where they say one, else the scenario's.
double half_minutes(const Simulator& settings, const sim::Scenario& scenario);

/// Every value of the scenario as TOML that load_scenario() reads back.
std::string to_toml_text(const sim::Scenario& scenario);

/// Every value by its key, e.g. "kicker.delay_s", as TOML has it.
std::map<std::string, std::string> scenario_values(const sim::Scenario& scenario);

/// Settings of nodes that play in this scenario: its goal, its field, its rules; whatever file they came from.
Settings on_field_of(const sim::Scenario& scenario, Settings settings);

/// In words, the first key of [goal] and [rules] in which settings and scenario differ. None: they agree.
std::optional<std::string> field_difference(const sim::Scenario& scenario, const Settings& settings);

/// The same of what the settings do not merely have by default, or have by a field file: on_field_of() would overrule
/// somebody's word.
std::optional<std::string> field_contradiction(const sim::Scenario& scenario, const Settings& settings);

/// A world of a study: another one than robots believe.
struct NamedWorld {
  std::string name;
  std::string why;  ///< these values
  sim::Scenario scenario{};
};

/// Reads the [[world]] tables of a file such as config/studies/robustness.toml: name, why, `scenario`, a file relative
/// to this one, else `base`, and `set`, lines of TOML on top. Throws Error naming file, line, key and value; also for a
/// file without worlds, for a world without a name and for two of one name.
std::vector<NamedWorld> load_worlds(const std::filesystem::path& path, const sim::Scenario& base);

}  // namespace trivela::config
