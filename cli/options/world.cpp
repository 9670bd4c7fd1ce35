#include "cli/options/world.hpp"

#include "cli/options/number_checks.hpp"
#include "config/scenario/scenario.hpp"

namespace trivela::cli {

sim::Scenario World::load() const {
  sim::Scenario scenario = config::load_scenario(file);
  for (const std::string& line : changes) config::override_scenario(scenario, line, "--world");
  return scenario;
}

std::string World::named(const std::string& base) const {
  std::string name = base;
  for (const std::string& line : changes) name += ", " + line;
  return name;
}

void add_world_options(CLI::App& verb, World& world) {
  add_default(verb, "--scenario", world.file, "The world", readable_file());
  verb.add_option("--world", world.changes, "One value of it on top, e.g. --world keeper.reaction_s=0.15");
}

}  // namespace trivela::cli
