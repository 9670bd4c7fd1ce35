#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/team/team.hpp"

namespace trivela::config {

/// A file of a machine's configuration, all of it.
struct TeamFile {
  std::string name;  ///< in the machine's folder
  std::string text;
};

/// What a machine of a team is configured with: settings.toml (nodes: the machine's own bus is the loopback, with a
/// discovery tag of team and machine), team_bus.xml (Cyclone, between the machines, for team_link), robot.env
/// (trivela-launch and systemd, and the own bus for programs of a team) and trivela.target.conf (systemd: which nodes
/// trivela.target starts). `robot` none: the base. They name each other as they lie in `folder`, and every other file
/// whole. `shipped_folder`: what robot.env says as TRIVELA_CONFIG; empty: nothing. The same for the same team. Throws
/// Error for settings that do not read, and for paths that robot.env cannot say.
std::vector<TeamFile> team_files(const Team& team, const TeamRobot* robot, const std::filesystem::path& folder,
                                 const std::filesystem::path& shipped_folder);

}  // namespace trivela::config
