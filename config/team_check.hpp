#pragma once

#include <string>
#include <vector>

#include "config/team.hpp"

namespace trivela::config {

/// In words with file and line, everything in which a team contradicts itself, the league or its robots' files: names,
/// addresses and numbers that two have, addresses outside the network, groups that are none, domains whose ports meet,
/// files that are missing or do not read, policies that a robot cannot play, traffic beyond the
/// budget. Reads those files. Empty: nothing.
std::vector<std::string> team_findings(const Team& team);

}  // namespace trivela::config
