#include "config/scenario/scenario.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

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

std::map<std::string, std::string> scenario_values(const sim::Scenario& scenario) {
  return values_in(to_toml(scenario));
}

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

namespace {

NamedWorld read_world(const TomlSource& source, const toml::node& node, const sim::Scenario& base) {
  const std::string place = fmt::format("{}:{}", source.file, node.source().begin.line);
  if (!node.is_table()) throw Error{place + ": world: expected [[world]]"};
  TableReader reader{source.file, *node.as_table(), "world"};
  NamedWorld world{.name = {}, .why = {}, .scenario = base};
  std::string file;
  std::vector<std::string> set;
  reader("name", world.name);
  reader("why", world.why);
  reader("scenario", file);
  reader("set", set);
  reader.refuse_unknown_keys();
  if (world.name.empty()) throw Error{place + ": world.name = \"\": a world needs a name"};
  if (!file.empty()) world.scenario = load_scenario(std::filesystem::path{source.file}.parent_path() / file);
  for (const std::string& line : set)
    override_scenario(world.scenario, line, fmt::format("{}: world {}: set", place, world.name));
  return world;
}

}  // namespace

std::vector<NamedWorld> load_worlds(const std::filesystem::path& path, const sim::Scenario& base) {
  const TomlSource source = parse_file(path);
  std::vector<NamedWorld> worlds;
  for (const auto& [key, node] : source.root) {
    if (key != "world" || !node.is_array())
      throw Error{fmt::format("{}:{}: {}: unknown key: a file of worlds holds [[world]] tables", source.file,
                              node.source().begin.line, key.str())};
    for (const toml::node& table : *node.as_array()) {
      worlds.push_back(read_world(source, table, base));
      const std::string& name = worlds.back().name;
      if (std::ranges::count(worlds, name, &NamedWorld::name) > 1)
        throw Error{
            fmt::format("{}:{}: world.name = \"{}\" stands there twice", source.file, table.source().begin.line, name)};
    }
  }
  if (worlds.empty()) throw Error{fmt::format("{}: no [[world]]", source.file)};
  return worlds;
}

}  // namespace trivela::config
