#include "config/scenario/worlds.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "config/scenario/scenario.hpp"
#include "config/text/toml_source.hpp"

namespace trivela::config {
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
