#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "config/team/team.hpp"

namespace trivela::config {

/// UDP ports of a DDS domain, those of 120 participants of a machine included.
constexpr std::uint32_t first_port(std::uint32_t domain) { return 7400 + 250 * domain; }
constexpr std::uint32_t last_port(std::uint32_t domain) { return first_port(domain) + 249; }

/// Discovery tag of a robot's own bus; two robots of a team never hear each other there.
std::string tag_of(const Team& team, const TeamRobot& robot);

/// What a robot's nodes play with: its settings' file, and on top of it what the team's file says. Files are named
/// where they lie now. Throws Error.
Settings settings_of(const Team& team, const TeamRobot& robot);

/// The same of the base's, which is refbox for the whole team.
Settings settings_of_base(const Team& team);

/// The policies that may come to be in charge.
std::vector<kicking::PolicyName> in_charge(const Settings& settings);

/// As load_settings() reads it: what differs from the defaults, and `always` (keys such as run.robot_id). Where a field
/// file says goal, field and rules, they are left to it.
std::string to_short_toml_text(const Settings& settings, const std::vector<std::string>& always);

/// A file of a machine's configuration, all of it.
struct TeamFile {
  std::string name;  ///< in the machine's folder
  std::string text;
};

/// What a machine of a team is configured with:
/// - settings.toml, for nodes: the machine's own bus is the loopback, with a discovery tag of team and machine
/// - team_bus.xml, for team_link: Cyclone between the machines
/// - robot.env, for trivela-launch, systemd and a team's programs: the own bus
/// - trivela.target.conf, for systemd: which nodes trivela.target starts
///
/// `robot` none: the base. They name each other as they lie in `folder`, and every other file
/// whole. `shipped_folder`: what robot.env says as TRIVELA_CONFIG; empty: nothing. The same for the same team. Throws
/// Error for settings that do not read, and for paths that robot.env cannot say.
std::vector<TeamFile> team_files(const Team& team, const TeamRobot* robot, const std::filesystem::path& folder,
                                 const std::filesystem::path& shipped_folder);

}  // namespace trivela::config
