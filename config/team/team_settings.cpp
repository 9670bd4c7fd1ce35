#include "config/team/team_settings.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <utility>

#include "config/team/team_bus.hpp"
#include "config/text/error.hpp"

namespace trivela::config {
namespace {

/// What every machine begins with. What only a run in the simulator has is left out.
Settings beginning(const Team& team, const std::string& file) {
  Settings settings;
  if (!file.empty()) settings = load_settings(file);
  settings.run.lockstep = false;
  settings.run.scenario = Run{}.scenario;
  settings.run.team = team.team.name;
  settings.domain.domain_id = team.domains.robot;
  settings.domain.dds_file.clear();
  settings.refbox.team_name = team.team.name;
  settings.team_link.domain_id = team.domains.team;
  if (!team.team.group.empty())
    settings.refbox.group = team.team.group;
  else if (team.team.number > 0)
    settings.refbox.group = fmt::format("224.16.32.{}", team.team.number);
  return settings;
}

std::string logs_of(const Team& team, const char* machine) {
  return (std::filesystem::path{team.team.logs} / fmt::format("{{team}}-{}-{{time}}.db", machine)).string();
}

}  // namespace

std::string tag_of(const Team& team, const TeamRobot& robot) {
  return fmt::format("{}-{}", team.team.name, robot.number);
}

Settings settings_of(const Team& team, const TeamRobot& robot) {
  Settings settings = beginning(team, robot.settings.empty() ? team.team.settings : robot.settings);
  settings.run.robot_id = robot.number;
  settings.run.robot = robot.robot;
  settings.domain.tag = tag_of(team, robot);
  settings.recorder.log = logs_of(team, "{robot}");
  settings.team_link.interface = team.interface_of(robot);
  if (robot.policy) settings.kick_decision.put_in_charge(*robot.policy);
  override_settings(settings, {});  // what follows from them together
  return settings;
}

Settings settings_of_base(const Team& team) {
  Settings settings = beginning(team, team.team.settings);
  settings.domain.tag = team.team.name + "-base";
  settings.recorder.log = logs_of(team, "base");
  settings.team_link.interface = team.interface_of_base();
  settings.team_link.base = true;
  settings.refbox.robots.clear();
  for (const TeamRobot& robot : team.robots) settings.refbox.robots.push_back(robot.number);
  if (!team.robots.empty()) {
    settings.run.robot_id = team.robots.front().number;
    settings.run.robot = team.robots.front().robot;
  }
  return settings;
}

std::vector<kicking::PolicyName> in_charge(const Settings& settings) {
  const KickDecision& k = settings.kick_decision;
  if (!k.random.empty()) return k.random;
  const std::size_t robot_id = settings.run.robot_id;  // 0 where the team's file has no usable number
  if (robot_id >= 1 && robot_id <= k.policy_by_robot.size()) return {k.policy_by_robot[robot_id - 1]};
  return k.policy_by_half;
}

std::string to_short_toml_text(const Settings& settings, const std::vector<std::string>& always) {
  const auto defaults = setting_values(Settings{});
  std::istringstream lines{to_toml_text(settings)};
  std::string text, section, shown;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) section = line.substr(1, line.size() - 2);
    const bool own = section.starts_with("policy.own.");  // makes a policy's name known
    if (own && section != shown) text += fmt::format("\n[{}]\n", shown = section);
    const auto equals = line.find(" = ");
    if (line.starts_with('[') || equals == std::string::npos) continue;
    const bool of_field = section == "goal" || section == "field" || section == "rules";
    if (of_field && !settings.run.field_file.empty()) continue;
    const std::string key = section + "." + line.substr(0, equals);
    const auto same = defaults.find(key);
    const bool differs = same == defaults.end() || same->second != line.substr(equals + 3);
    if (!differs && !own && std::ranges::find(always, key) == always.end()) continue;
    if (section != shown) text += fmt::format("\n[{}]\n", section);
    shown = section;
    text += line + "\n";
  }
  return text;
}

namespace {

constexpr const char* kTeamBus = "team_bus.xml";

/// Those of the decision path, with their SCHED_FIFO priority: what keeps the devices safe goes before what computes,
/// and the second decision node before a first that hangs in a loop.
constexpr std::pair<std::string_view, int> kRealtime[]{{"odometry", 50},    {"kicker_driver", 50},
                                                       {"world_state", 40}, {"kick_decision", 40},
                                                       {"chain", 40},       {"kick_decision_second", 41}};

std::vector<std::string> nodes_of(const Settings& settings, bool base) {
  if (base) return {"recorder", "team_link", "refbox"};
  std::vector<std::string> nodes{"recorder", "team_link"};
  for (const std::string& node : decision_path(settings)) nodes.push_back(node);
  if (settings.kick_decision.standby) nodes.emplace_back("kick_decision_second");
  for (const char* const node : {"kicker_driver", "shot_observer", "kicker_drift"}) nodes.emplace_back(node);
  return nodes;
}

/// KEY="value", as sh and systemd both read it.
std::string env_line(const std::string& key, const std::string& value) {
  if (value.find_first_of("\"\\$`\n") != std::string::npos)
    throw Error{fmt::format("robot.env: {} = \"{}\": no path with \" \\ $ ` or a line's end", key, value)};
  return fmt::format("{}=\"{}\"\n", key, value);
}

std::string env_text(const Team& team, const std::vector<std::string>& nodes, const std::filesystem::path& folder,
                     const std::filesystem::path& shipped_folder, const std::string& tag) {
  std::string text;
  if (!shipped_folder.empty()) text += env_line("TRIVELA_CONFIG", shipped_folder.string());
  text += env_line("TRIVELA_SETTINGS", (folder / "settings.toml").string());
  text += env_line("TRIVELA_FOLDER", team.team.logs);
  if (!shipped_folder.empty())
    text += env_line("CYCLONEDDS_URI", "file://" + (shipped_folder / "cyclonedds/loopback.xml").string());
  text += env_line("TRIVELA_TAG", tag);
  if (!team.team.keys.empty()) text += env_line("TRIVELA_SECURITY", team.team.keys);
  text += env_line("TRIVELA_NODES", fmt::format("{}", fmt::join(nodes, " ")));
  for (const auto& [node, priority] : kRealtime)
    if (std::ranges::find(nodes, node) != nodes.end())
      text += env_line(fmt::format("TRIVELA_FLAGS_{}", node), fmt::format("--realtime {}", priority));
  return text;
}

/// A drop-in of trivela.target: whoever starts it starts these.
std::string target_text(const std::vector<std::string>& nodes) {
  std::string text = "[Unit]\n";
  for (const std::string& node : nodes) text += fmt::format("Wants=trivela@{}.service\n", node);
  return text;
}

Settings settings_in(const Team& team, const TeamRobot* robot, const std::filesystem::path& folder) {
  Settings settings = robot == nullptr ? settings_of_base(team) : settings_of(team, *robot);
  make_files_whole(settings);
  settings.team_link.dds_file = (folder / kTeamBus).string();
  settings.run.scenario = Run{}.scenario;  // the simulator's
  return settings;
}

}  // namespace

std::vector<TeamFile> team_files(const Team& team, const TeamRobot* robot, const std::filesystem::path& folder,
                                 const std::filesystem::path& shipped_folder) {
  const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  const Settings settings = settings_in(team, robot, whole);
  const std::vector<std::string> nodes = nodes_of(settings, robot == nullptr);
  const std::string interface = robot == nullptr ? team.interface_of_base() : team.interface_of(*robot);
  return {{"settings.toml", to_short_toml_text(settings, {"run.robot_id", "run.robot", "domain.domain_id"})},
          {kTeamBus, team_bus_xml(team, interface)},
          {"robot.env", env_text(team, nodes, whole, shipped_folder, settings.domain.tag)},
          {"trivela.target.conf", target_text(nodes)}};
}

}  // namespace trivela::config
