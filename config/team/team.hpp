#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kicking/policy/policy.hpp"

/// A team in one file, team.toml (config/teams/example.toml), out of which every machine's configuration is made
/// (config/team/team_files.hpp).
namespace trivela::config {

/// The line of each key that a table of the file has; "" is the table's own.
using Lines = std::map<std::string, std::uint32_t, std::less<>>;

/// [team]: what all its machines share.
struct TeamFields {
  std::string name;                      ///< in discovery tags and names of logs
  std::uint32_t number = 0;              ///< N of the league's 172.16.N.* and 224.16.32.N; 0: none
  std::string network;                   ///< every machine's address lies in it, such as 172.16.39.0/24
  std::string interface = "wlan0";       ///< by which a machine is in that network
  std::string group;                     ///< multicast group of the discovery; empty: peers
  std::vector<std::string> peers;        ///< without a group: who is asked beside robots and base
  std::string settings;                  ///< file that every machine's settings begin with; empty: the defaults
  std::string logs;                      ///< folder of the recorders on the robots
  std::string keys;                      ///< folder of the keys on each machine; empty: the buses are not secured
  std::uint32_t budget_bps = 1'000'000;  ///< of all machines together; the league's monitor alarms at 2.2 Mbit/s
  Lines lines;
};

/// [domains]: DDS domains. They must differ, since one node of a robot is in both.
struct TeamDomains {
  std::uint32_t robot = 42;  ///< of each robot's own bus, on its loopback
  std::uint32_t team = 43;   ///< of the bus between the machines
  Lines lines;
};

/// One [[robot]].
struct TeamRobot {
  std::uint32_t number = 0;  ///< run.robot_id
  std::string address;
  std::string robot;                          ///< its file
  std::optional<kicking::PolicyName> policy;  ///< none: its settings say
  std::string settings;                       ///< in place of the team's; empty: those
  std::string interface;                      ///< in place of the team's; empty: that
  Lines lines;
};

/// [base]: the machine beside the field, which has the referee box's word.
struct TeamBase {
  std::string address;
  std::string interface;  ///< in place of the team's; empty: that
  Lines lines;
};

/// A team.toml; names of files are relative to it until load_team() has made them whole.
struct Team {
  std::string file;  ///< for messages
  TeamFields team;
  TeamDomains domains;
  std::vector<TeamRobot> robots;
  TeamBase base;

  /// "team.toml:12" where the table has the key, else the table's own place, or the file.
  std::string place(const Lines& lines, std::string_view key) const;
  /// None: the team has no robot of that number.
  const TeamRobot* robot(std::uint32_t number) const;
  std::string interface_of(const TeamRobot& robot) const;
  std::string interface_of_base() const { return base.interface.empty() ? team.interface : base.interface; }
};

/// What a file says, and in words what cannot be read in it: unknown keys, wrong types, values out of range, each with
/// file, line, key and value.
struct ReadTeam {
  Team team;
  std::vector<std::string> findings;
};

/// Reads a team.toml, and goes on after what is wrong. Throws Error where there is no file or it is no TOML.
ReadTeam load_team(const std::filesystem::path& path);

/// In words with file and line, everything in which a team contradicts itself, the league or its robots' files: names,
/// addresses and numbers that two have, addresses outside the network, groups that are none, domains whose ports meet,
/// files that are missing or do not read, policies that a robot cannot play, traffic beyond the
/// budget. Reads those files. Empty: nothing.
std::vector<std::string> team_findings(const Team& team);

}  // namespace trivela::config
