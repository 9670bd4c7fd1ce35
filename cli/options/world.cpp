#include "cli/options/world.hpp"

#include <fmt/format.h>

#include "cli/options/number_checks.hpp"
#include "config/scenario/scenario.hpp"

namespace trivela::cli {
namespace {

/// Throws UsageError where the line names a value of something that the world has not: a keeper, a lever, a laser.
void refuse_without_effect(const std::string& line, const std::map<std::string, std::string>& values) {
  const std::string key = line.substr(0, line.find_first_of(" \t="));
  for (auto dot = key.find('.'); dot != std::string::npos; dot = key.find('.', dot + 1)) {
    const std::string enabled = key.substr(0, dot) + ".enabled";
    const auto value = values.find(enabled);
    if (key != enabled && value != values.end() && value->second == "false")
      throw UsageError{fmt::format("--world {}: {} has no effect, since {} = false in this world", line, key, enabled)};
  }
}

}  // namespace

sim::Scenario World::load() const {
  sim::Scenario scenario = config::load_scenario(file);
  for (const std::string& line : changes) config::override_scenario(scenario, line, "--world");
  const auto values = config::scenario_values(scenario);
  for (const std::string& line : changes) refuse_without_effect(line, values);
  return scenario;
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
