#include "config/team/team_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "config/team/team_bus.hpp"
#include "config/team/team_settings.hpp"
#include "config/text/error.hpp"

namespace trivela::config {
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
