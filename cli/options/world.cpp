#include "cli/options/world.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/options/number_checks.hpp"
#include "config/scenario/scenario.hpp"

namespace trivela::cli {
namespace {

/// The key by which the scenario has nothing of what `key` is a value of: a keeper, a lever, a laser. Empty: it has it.
std::string switched_off(const std::string& key, const sim::Scenario& scenario) {
  const auto values = config::scenario_values(scenario);
  for (auto dot = key.find('.'); dot != std::string::npos; dot = key.find('.', dot + 1)) {
    std::string enabled = key.substr(0, dot) + ".enabled";
    const auto value = values.find(enabled);
    if (key != enabled && value != values.end() && value->second == "false") return enabled;
  }
  return {};
}

}  // namespace

sim::Scenario World::load() const {
  sim::Scenario scenario = config::load_scenario(file);
  for (const std::string& line : changes) config::override_scenario(scenario, line, "--world");
  return scenario;
}

void World::require_effect(const std::vector<sim::Scenario>& played) const {
  for (const std::string& line : changes) {
    const std::string key = line.substr(0, line.find_first_of(" \t="));
    const auto has_it = [&](const sim::Scenario& scenario) { return switched_off(key, scenario).empty(); };
    if (std::ranges::none_of(played, has_it))
      throw UsageError{fmt::format("--world {}: {} has no effect, since {} = false in {}", line, key,
                                   switched_off(key, played.front()), played.size() > 1 ? "all worlds" : "this world")};
  }
}

std::string World::named(const std::string& base) const {
  std::string name = base;
  for (const std::string& line : changes) name += ", " + line;
  return name;
}

void add_world_options(CLI::App& verb, World& world) {
  add_default(verb, "--scenario", world.file, "The world", readable_file());
  verb.add_option("--world", world.changes, "One value of it on top, e.g. --world kicker.delay_s=0.03");
}

}  // namespace trivela::cli
