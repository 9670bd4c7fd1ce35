#include "config/arms.hpp"

#include <fmt/core.h>

#include "config/settings_fields.hpp"
#include "config/toml_source.hpp"

namespace trivela::config {

template <class V>
void fields(V& v, ArmFields& a) {
  v("name", a.name);
  v("policy", a.policy);
  v("table", a.table);
  v("robots", a.robots);
  v("set", a.set);
  v("random", a.random);
  v("random_probabilities", a.random_probabilities, Range{0.0, 1.0});
}

namespace {

ArmFields read_arm(const TomlSource& source, const toml::node& node) {
  const auto line = node.source().begin.line;
  if (!node.is_table()) throw Error{fmt::format("{}:{}: arm: expected [[arm]]", source.file, line)};
  ArmFields arm;
  TableReader reader{source.file, *node.as_table(), "arm"};
  fields(reader, arm);
  reader.refuse_unknown_keys();
  if (arm.name.empty()) throw Error{fmt::format("{}:{}: arm.name: an arm needs a name", source.file, line)};
  if (arm.table != "new" && arm.table != "old") {
    throw Error{fmt::format("{}:{}: arm.table = \"{}\": expected one of: new, old", source.file, line, arm.table)};
  }
  const std::filesystem::path folder = std::filesystem::path{source.file}.parent_path();
  for (std::string& robot : arm.robots) {
    if (std::filesystem::path{robot}.is_relative()) robot = (folder / robot).string();
  }
  return arm;
}

}  // namespace

std::vector<ArmFields> load_arms(const std::filesystem::path& path) {
  const TomlSource source = parse_file(path);
  std::vector<ArmFields> arms;
  for (const auto& [key, node] : source.root) {
    if (key != "arm" || !node.is_array()) {
      throw Error{fmt::format("{}:{}: {}: unknown key: a file of arms holds [[arm]] tables", source.file,
                              node.source().begin.line, key.str())};
    }
    for (const toml::node& table : *node.as_array()) {
      arms.push_back(read_arm(source, table));
      for (std::size_t i = 0; i + 1 < arms.size(); ++i) {
        if (arms[i].name != arms.back().name) continue;
        throw Error{fmt::format("{}:{}: arm.name = \"{}\" stands there twice", source.file, table.source().begin.line,
                                arms.back().name)};
      }
    }
  }
  if (arms.empty()) throw Error{fmt::format("{}: no [[arm]]", source.file)};
  return arms;
}

}  // namespace trivela::config
