#pragma once

#include <filesystem>
#include <string>

#include "config/robot.hpp"

namespace trivela::cli {

/// Today in UTC, YYYY-MM-DD.
std::string today();

/// The file that --robot means: a path (with a slash or ending in .toml) as it is; of a plain name
/// config/robots/NAME.toml or NAME.toml in the current folder, else the shipped one. Throws std::runtime_error naming
/// all that were tried.
std::filesystem::path find_robot(const std::string& name_or_file);

/// Where the file of a robot called NAME goes: `out` if given, else config/robots/NAME.toml in the current folder if
/// that has config/robots, else NAME.toml. Throws UsageError unless NAME is of letters, digits, '_' and '-'.
std::filesystem::path robot_target(const std::string& name, const std::string& out);

/// What a calibration of robot NAME starts from: the file at `target` where there is one, which must be that robot's;
/// else `start`, or the shipped cambada_1 if that is empty, under the new name.
/// Throws config::Error, UsageError for a `start` beside an existing file or a file of another robot.
config::Robot robot_to_calibrate(const std::string& name, const std::filesystem::path& target,
                                 const std::string& start);

}  // namespace trivela::cli
