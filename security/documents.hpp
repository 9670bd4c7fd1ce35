#pragma once

#include <cstdint>
#include <string>

#include "security/rights.hpp"
#include "security/validity.hpp"

namespace trivela::security {

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
