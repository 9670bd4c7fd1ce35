#include "config/team/team_settings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

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
  if (robot.policy) {
    settings.kick_decision.policy_by_half = {*robot.policy};
    settings.kick_decision.policy_by_robot.clear();
    settings.kick_decision.random.clear();
    settings.kick_decision.random_probabilities.clear();
  }
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

}  // namespace trivela::config
