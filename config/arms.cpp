#include "config/arms.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "config/settings_fields.hpp"
#include "config/text/error.hpp"
#include "config/text/toml_source.hpp"
#include "kicking/text/nearest_word.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::config {

void fields(auto& v, ArmFields& a) {
  v("name", a.name);
  v("policy", a.policy);
  v("table", a.table);
  v("robots", a.robots);
  v("config", a.config);
  v("random", a.random);
  v("random_probabilities", a.random_probabilities, Range{0.0, 1.0});
}

namespace {

constexpr std::size_t kLongestName = 64;  // bytes

/// The place of a key of an arm; of the arm, where it does not have it.
std::string place_of(const TomlSource& source, const toml::table& arm, std::string_view key) {
  const toml::node* const node = arm.get(key);
  return fmt::format("{}:{}", source.file, (node != nullptr ? *node : arm).source().begin.line);
}

void check_name(const std::string& name, const std::string& place) {
  if (name.empty()) throw Error{fmt::format("{}: arm.name = \"\": an arm needs a name", place)};
  const std::string shown = kicking::printable(name);
  const bool plain = shown == name && name.find('\t') == std::string::npos;
  if (!plain) throw Error{fmt::format("{}: arm.name = \"{}\": has a control character", place, shown)};
  if (name.size() > kLongestName) {
    throw Error{fmt::format("{}: arm.name = \"{}\": has {} bytes, and {} at most are a name", place, shown, name.size(),
                            kLongestName)};
  }
}

void check_draw(const TomlSource& source, const toml::table& table, const ArmFields& arm) {
  const auto place = [&](const char* key) { return fmt::format("{}: arm {}", place_of(source, table, key), arm.name); };
  if (arm.policy && !arm.random.empty()) {
    throw Error{fmt::format("{}: policy = \"{}\" says who plays, and so does the arm's random; leave one out",
                            place("policy"), kicking::name(*arm.policy))};
  }
  KickDecision draw;
  draw.random = arm.random;
  draw.random_probabilities = arm.random_probabilities;
  check_policies(draw, place(arm.random_probabilities.empty() ? "random" : "random_probabilities"));
}

std::vector<SettingLine> read_set(const TomlSource& source, TableReader& reader, const toml::table& table,
                                  const std::string& arm) {
  std::vector<std::string> texts;
  reader("set", texts);
  std::vector<SettingLine> lines;
  for (const std::string& text : texts) {
    const auto line = table["set"][lines.size()].node()->source().begin.line;
    lines.push_back({text, fmt::format("{}:{}: arm {}: set \"{}\"", source.file, line, arm, text)});
  }
  return lines;
}

ArmFields read_arm(const TomlSource& source, const toml::node& node) {
  if (!node.is_table()) throw Error{fmt::format("{}:{}: arm: expected [[arm]]", source.file, node.source().begin.line)};
  const toml::table& table = *node.as_table();
  ArmFields arm;
  TableReader reader{source.file, table, "arm"};
  fields(reader, arm);
  check_name(arm.name, place_of(source, table, "name"));
  arm.set = read_set(source, reader, table, arm.name);
  reader.refuse_unknown_keys();
  arm.place = fmt::format("{}:{}: arm {}", source.file, node.source().begin.line, arm.name);
  if (arm.table != "new" && arm.table != "old") {
    throw Error{
        fmt::format("{}: arm.table = \"{}\": expected one of: new, old", place_of(source, table, "table"), arm.table)};
  }
  check_draw(source, table, arm);
  const std::filesystem::path folder = std::filesystem::path{source.file}.parent_path();
  const auto relative_to_file = [&](std::string& path) {
    if (!path.empty() && std::filesystem::path{path}.is_relative()) path = (folder / path).string();
  };
  std::ranges::for_each(arm.robots, relative_to_file);
  relative_to_file(arm.config);
  return arm;
}

void append_keys(const toml::table& table, const std::string& section, std::vector<std::string>& keys) {
  for (const auto& [key, node] : table) {
    const std::string full = section + std::string{key.str()};
    if (node.is_table())
      append_keys(*node.as_table(), full + ".", keys);
    else
      keys.push_back(full);
  }
}

std::vector<ArmFields> read_arms(const TomlSource& source) {
  std::vector<ArmFields> arms;
  for (const auto& [key, node] : source.root) {
    if (key != "arm" || !node.is_array()) {
      throw Error{fmt::format("{}:{}: {}: unknown key: a file of arms holds [[arm]] tables", source.file,
                              node.source().begin.line, key.str())};
    }
    for (const toml::node& table : *node.as_array()) {
      arms.push_back(read_arm(source, table));
      const std::string& name = arms.back().name;
      if (std::ranges::count(arms, name, &ArmFields::name) == 1) continue;
      throw Error{
          fmt::format("{}: arm.name = \"{}\" stands there twice", place_of(source, *table.as_table(), "name"), name)};
    }
  }
  if (arms.empty()) throw Error{fmt::format("{}: no [[arm]]", source.file)};
  return arms;
}

}  // namespace

std::vector<ArmFields> load_arms(const std::filesystem::path& path) { return read_arms(parse_file(path)); }

std::vector<ArmFields> parse_arms(const std::string& text, const std::string& name) {
  return read_arms(parse_text(text, name));
}

void require_own_policy(std::string_view key, const std::string& place) {
  constexpr std::string_view kOwn = "policy.own.";
  if (!key.starts_with(kOwn)) return;
  const std::string name{key.substr(kOwn.size(), key.find('.', kOwn.size()) - kOwn.size())};
  std::vector<std::string> known;
  for (const kicking::Policy* policy : kicking::policies().subspan(kicking::kPolicyCount))
    if (!policy->facts().needs_program()) known.emplace_back(policy->facts().name);
  if (std::ranges::find(known, name) != known.end()) return;
  const auto meant = kicking::nearest_word(name, known);
  throw BadArgument{fmt::format("{}: this program has no policy {} of its own{}", place, name,
                                meant ? fmt::format("; did you mean {}?", *meant) : "")};
}

std::vector<std::string> override_setting(Settings& settings, const SettingLine& line) {
  try {
    const TomlSource source = parse_text(line.text, "");
    std::vector<std::string> keys;
    append_keys(source.root, "", keys);
    for (const std::string& key : keys) require_own_policy(key, line.place);
    read_into(source, settings);
    return keys;
  } catch (const Error& error) {
    const std::string what = error.what();  // ":1: what is wrong", the line being the text's own
    throw Error{fmt::format("{}: {}{}", line.place, what.substr(what.find(": ") + 2),
                            line.place.starts_with("--set ") ? quotes_advice(what, line.text, "--set") : "")};
  }
}

}  // namespace trivela::config
