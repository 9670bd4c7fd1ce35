#include "config/scenario/scenario.hpp"

#include <fmt/core.h>

#include "config/field.hpp"
#include "config/text/toml_source.hpp"
#include "config/text/toml_text.hpp"
#include "sim/scenario_fields.hpp"

namespace trivela::config {

namespace {

/// Takes field and rules from the file that field_file names, if any, and the key out of the source.
void take_field_file(TomlSource& source, const std::filesystem::path& path, sim::Scenario& scenario) {
  const toml::node* const node = source.root.get("field_file");
  if (node == nullptr) return;
  const auto refuse = [&](const toml::node& where, const std::string& why) {
    throw Error{fmt::format("{}:{}: {}", source.file, where.source().begin.line, why)};
  };
  const auto name = node->value<std::string>();
  if (!name) refuse(*node, "field_file: expected a text");
  for (const char* const table : {"field", "rules"}) {
    if (const toml::node* const own = source.root.get(table))
      refuse(*own, fmt::format("[{}]: field_file, {}, says it", table, *name));
  }
  const FieldFile field = load_field(path.parent_path() / *name);
  scenario.field = field.field;
  scenario.rules = field.rules;
  source.root.erase("field_file");
}

}  // namespace

sim::Scenario load_scenario(const std::filesystem::path& path) {
  sim::Scenario scenario;
  TomlSource source = parse_file(path);
  take_field_file(source, path, scenario);
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

double half_minutes(const Simulator& settings, const sim::Scenario& scenario) {
  return settings.half_minutes > 0.0 ? settings.half_minutes : scenario.referee.half_minutes;
}

std::string to_toml_text(const sim::Scenario& scenario) { return to_toml(scenario); }

}  // namespace trivela::config
