#include "config/scenario/scenario_field.hpp"

#include <fmt/core.h>

#include <utility>

#include "config/field.hpp"

namespace trivela::config {

namespace {

/// The first key of [goal] and [rules] in which they differ and whose value in the settings is not `but_for`'s.
std::optional<std::string> first_difference(const sim::Scenario& scenario, const Settings& settings,
                                            const Settings* but_for) {
  const auto own = setting_values(settings), played = setting_values(on_field_of(scenario, settings));
  const auto excused = but_for ? setting_values(*but_for) : std::map<std::string, std::string>{};
  for (const auto& [key, value] : own) {
    if (!key.starts_with("goal.") && !key.starts_with("rules.")) continue;
    const auto same = excused.find(key);
    if (value == played.at(key) || (same != excused.end() && same->second == value)) continue;
    return fmt::format("{} = {}, but the scenario's [field] and [rules] say {}", key, value, played.at(key));
  }
  return std::nullopt;
}

}  // namespace

Settings on_field_of(const sim::Scenario& scenario, Settings settings) {
  settings.run.field_file.clear();
  return on_field({scenario.field, scenario.rules}, std::move(settings));
}

std::optional<std::string> field_difference(const sim::Scenario& scenario, const Settings& settings) {
  return first_difference(scenario, settings, nullptr);
}

std::optional<std::string> field_contradiction(const sim::Scenario& scenario, const Settings& settings) {
  const Settings defaults;
  return first_difference(scenario, settings, settings.run.field_file.empty() ? &defaults : nullptr);
}

}  // namespace trivela::config
