#pragma once

#include <string>
#include <vector>

#include "config/arms.hpp"
#include "config/settings.hpp"

namespace trivela::experiment {

/// The settings that an arm plays by: those of the file `config`, then `overrides`, then the arm's own lines. Throws
/// config::BadArgument for a line that names what plays no part in process, with what to use instead, and for one
/// that says who plays where the arm does, too; config::Error naming line, key and value where it cannot be read.
config::Settings arm_settings(const config::ArmFields& arm, const std::string& config,
                              std::vector<config::SettingLine> overrides);

}  // namespace trivela::experiment
