#pragma once

#include <string>
#include <vector>

#include "config/arms.hpp"
#include "config/settings.hpp"

namespace trivela::experiment {

/// The settings that an arm plays by: those of the file `config`, then `overrides` (lines of --set), then the arm's own
/// lines. Throws UsageError for a line that names what plays no part in process, with what to use instead, and for one
/// that says who plays where the arm does, too; config::Error naming line, key and value where it cannot be read.
config::Settings arm_settings(const config::ArmFields& arm, const std::string& config,
                              const std::vector<std::string>& overrides);

}  // namespace trivela::experiment
