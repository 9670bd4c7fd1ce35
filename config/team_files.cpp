#include "config/team_files.hpp"

#include <fmt/core.h>

#include "config/error.hpp"
#include "config/team_bus.hpp"
#include "config/team_settings.hpp"

namespace trivela::config {
namespace {

constexpr const char* kTeamBus = "team_bus.xml";

/// KEY="value", as sh and systemd both read it.
std::string env_line(const char* key, const std::string& value) {
  if (value.find_first_of("\"\\$`\n") != std::string::npos)
    throw Error{fmt::format("robot.env: {} = \"{}\": no path with \" \\ $ ` or a line's end", key, value)};
  return fmt::format("{}=\"{}\"\n", key, value);
}

std::string env_text(const Team& team, const TeamRobot* robot, const std::filesystem::path& folder,
                     const std::filesystem::path& shipped_folder, const std::string& tag) {
  std::string text;
  if (!shipped_folder.empty()) text += env_line("TRIVELA_CONFIG", shipped_folder.string());
  text += env_line("TRIVELA_SETTINGS", (folder / "settings.toml").string());
  text += env_line("TRIVELA_FOLDER", team.team.logs);
  if (!shipped_folder.empty())
    text += env_line("CYCLONEDDS_URI", "file://" + (shipped_folder / "cyclonedds/loopback.xml").string());
  text += env_line("TRIVELA_TAG", tag);
  if (robot == nullptr) return text + env_line("TRIVELA_NODES", "recorder team_link refbox");
  text += env_line("TRIVELA_NODES",
                   "recorder team_link odometry world_state kick_decision kicker_driver shot_observer kicker_drift");
  text += env_line("TRIVELA_FLAGS_odometry", "--realtime 50");
  return text + env_line("TRIVELA_FLAGS_kicker_driver", "--realtime 50");
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
  const std::string interface = robot == nullptr ? team.interface_of_base() : team.interface_of(*robot);
  return {{"settings.toml", to_short_toml_text(settings, {"run.robot_id", "run.robot", "domain.domain_id"})},
          {kTeamBus, team_bus_xml(team, interface)},
          {"robot.env", env_text(team, robot, whole, shipped_folder, settings.domain.tag)}};
}

}  // namespace trivela::config
