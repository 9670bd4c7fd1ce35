#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "security/certificates.hpp"

namespace trivela::security {

/// The topics that one kind of node writes and reads, and nothing else of the bus.
struct Rights {
  std::string node;
  std::vector<std::string> publish;
  std::vector<std::string> subscribe;
  /// Has an identity on a robot without being asked for: the simulator, which stands in for the world, has
  /// not, since it may write what referee and devices say, nor chain, since it may do what three nodes may.
  bool on_robot = true;
  /// And on the base.
  bool on_base = false;
};

/// Of every kind of node, in the order of the chain, and of the team's own processes of idl/README.md: they write what
/// the IDL's @writers say, and read what the programs take (nodes/runtime/readers.hpp).
const std::vector<Rights>& all_rights();

/// A machine's identity on the team's bus, where its team_link speaks: it says its state and hears the others', and the
/// base (robot 0) says the referee's word too. The name is not its own bus's: permissions of there are none of here.
Rights rights_on_team_bus(std::uint32_t robot_id);

/// Of one kind. Throws std::invalid_argument naming it and the known ones if there is none.
const Rights& rights_of(std::string_view node);

/// What certificates and permissions call a robot's node: "kick_decision.1". A slash, as owners of writers have it,
/// would be a separator in a subject name.
std::string common_name(std::string_view node, std::uint32_t robot_id);

/// A robot's own bus on its loopback, or the one between the machines.
enum class Bus { kRobot, kTeam };

/// What holds for everybody (DDS Security, governance): nobody without a certificate, every topic read and written by
/// right alone, discovery encrypted. On a robot's own bus each packet is signed, and kick_order, kicker_status and
/// referee are encrypted by keys that their readers alone have; on the team's, where everybody may read everything,
/// each packet is encrypted as a whole, once (docs/decisions/0058-what-protects-which-bus.md).
std::string governance_xml(Bus bus);

/// What the robot's node may write and read while that holds; everything else is denied.
std::string permissions_xml(const Rights& rights, std::uint32_t robot_id, const Validity& validity);

}  // namespace trivela::security
