#include "config/team/team.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "config/settings_fields.hpp"
#include "config/text/toml_source.hpp"
#include "kicking/text/nearest_word.hpp"

namespace trivela::config {

void fields(auto& v, TeamFields& t) {
  v("name", t.name);
  v("number", t.number, Range{0, 255});
  v("network", t.network);
  v("interface", t.interface);
  v("group", t.group);
  v("peers", t.peers);
  v("settings", t.settings);
  v("logs", t.logs);
  v("keys", t.keys);
  v("budget_bps", t.budget_bps, Range{10'000, 100'000'000});
}

void fields(auto& v, TeamDomains& d) {
  v("robot", d.robot, Range{0, 100});
  v("team", d.team, Range{0, 100});
}

void fields(auto& v, TeamRobot& r) {
  v("number", r.number, Range{1, 255});
  v("address", r.address);
  v("robot", r.robot);
  v("policy", r.policy);
  v("settings", r.settings);
  v("interface", r.interface);
}

void fields(auto& v, TeamBase& b) {
  v("address", b.address);
  v("interface", b.interface);
}

namespace {

/// Reads the fields of a table and goes on after one that is wrong.
class PatientReader {
 public:
  PatientReader(TableReader& reader, std::vector<std::string>& findings) : reader_(reader), findings_(findings) {}

  template <class... What>
  void operator()(std::string_view key, What&&... what) {
    try {
      reader_(key, std::forward<What>(what)...);
    } catch (const Error& wrong) {
      findings_.emplace_back(wrong.what());
    }
  }

 private:
  TableReader& reader_;
  std::vector<std::string>& findings_;
};

template <class S>
void read_table(const TomlSource& source, const toml::node& node, const std::string& name, S& into,
                std::vector<std::string>& findings) {
  into.lines[""] = node.source().begin.line;
  if (!node.is_table()) {
    findings.push_back(fmt::format("{}:{}: {}: expected a table", source.file, node.source().begin.line, name));
    return;
  }
  const toml::table& table = *node.as_table();
  for (const auto& [key, value] : table) into.lines[std::string{key.str()}] = key.source().begin.line;
  TableReader reader{source.file, table, name};
  PatientReader patient{reader, findings};
  fields(patient, into);
  std::ranges::copy(reader.unknown_keys(), std::back_inserter(findings));
}

void read_robots(const TomlSource& source, ReadTeam& read) {
  const toml::node* const robots = source.root.get("robot");
  if (robots == nullptr) return;
  if (!robots->is_array_of_tables()) {
    read.findings.push_back(
        fmt::format("{}:{}: robot: expected [[robot]] tables", source.file, robots->source().begin.line));
    return;
  }
  constexpr std::size_t kMost = 255;  // numbers that there are
  if (robots->as_array()->size() > kMost) {
    read.findings.push_back(fmt::format("{}:{}: robot: {} tables: at most {}", source.file, robots->source().begin.line,
                                        robots->as_array()->size(), kMost));
    return;
  }
  for (const toml::node& table : *robots->as_array())
    read_table(source, table, "robot", read.team.robots.emplace_back(), read.findings);
}

void refuse_other_tables(const TomlSource& source, std::vector<std::string>& findings) {
  const std::vector<std::string> known{"team", "domains", "robot", "base"};
  for (const auto& [key, node] : source.root) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    const auto meant = kicking::nearest_word(key.str(), known);
    findings.push_back(fmt::format("{}:{}: {}: unknown key{}", source.file, key.source().begin.line, key.str(),
                                   meant ? fmt::format("; did you mean {}?", *meant) : ""));
  }
}

void make_whole(const std::filesystem::path& folder, std::string& name) {
  if (!name.empty() && std::filesystem::path{name}.is_relative()) name = (folder / name).string();
}

}  // namespace

std::string Team::place(const Lines& lines, std::string_view key) const {
  const auto line = lines.contains(key) ? lines.find(key) : lines.find("");
  return line == lines.end() ? file : fmt::format("{}:{}", file, line->second);
}

const TeamRobot* Team::robot(std::uint32_t number) const {
  const auto found = std::ranges::find(robots, number, &TeamRobot::number);
  return found == robots.end() ? nullptr : &*found;
}

std::string Team::interface_of(const TeamRobot& robot) const {
  return robot.interface.empty() ? team.interface : robot.interface;
}

ReadTeam load_team(const std::filesystem::path& path) {
  const TomlSource source = parse_file(path);
  ReadTeam read;
  read.team.file = source.file;
  const auto table = [&](const char* name, auto& into) {
    if (const toml::node* const node = source.root.get(name)) read_table(source, *node, name, into, read.findings);
  };
  table("team", read.team.team);
  table("domains", read.team.domains);
  read_robots(source, read);
  table("base", read.team.base);
  refuse_other_tables(source, read.findings);
  const std::filesystem::path folder = path.parent_path();
  make_whole(folder, read.team.team.settings);
  for (TeamRobot& robot : read.team.robots) {
    make_whole(folder, robot.robot);
    make_whole(folder, robot.settings);
  }
  return read;
}

}  // namespace trivela::config
