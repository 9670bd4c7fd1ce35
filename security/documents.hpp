#pragma once

#include <cstdint>
#include <string>

#include "security/rights.hpp"
#include "security/validity.hpp"

namespace trivela::security {

/// What holds for everybody (DDS Security, governance): nobody without a certificate, discovery encrypted, each packet
/// signed; kick_order, kicker_status and referee encrypted too; every topic read and written by right alone.
std::string governance_xml();

/// What the robot's node may write and read while that holds; everything else is denied.
std::string permissions_xml(const Rights& rights, std::uint32_t robot_id, const Validity& validity);

}  // namespace trivela::security
