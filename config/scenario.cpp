#include "config/scenario.hpp"

#include <fmt/core.h>

#include "config/toml_source.hpp"
#include "config/toml_text.hpp"
#include "sim/scenario_fields.hpp"

namespace trivela::config {

sim::Scenario load_scenario(const std::filesystem::path& path) {
  sim::Scenario scenario;
  const TomlSource source = parse_file(path);
  read_into(source, scenario);
  if (const auto problem = sim::first_problem(scenario)) {
    const toml::node_view node = source.root.at_path(problem->key);
    throw Error{fmt::format("{}:{}: {}: {}", source.file, node ? node.node()->source().begin.line : 0u, problem->key,
                            problem->why)};
  }
  return scenario;
}

void override_scenario(sim::Scenario& scenario, const std::string& line, const std::string& called) {
  const TomlSource source = parse_text(line, called);
  read_into(source, scenario);
  if (const auto problem = sim::first_problem(scenario))
    throw Error{fmt::format("{} {}: {}: {}", called, line, problem->key, problem->why)};
}

std::string to_toml_text(const sim::Scenario& scenario) { return to_toml(scenario); }

}  // namespace trivela::config
