#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

#include "config/robot.hpp"
#include "kicking/learning/kicker_estimate.hpp"

namespace trivela::config {

/// The estimate of a robot's kicker that an earlier match left at `path`; none: there is no such file. Throws Error
/// that names the file where
/// - it cannot be read, or has numbers that no kicker has;
/// - it is older than `max_age_h`, or of the future;
/// - it is of another robot, or of this robot with another file.
std::optional<kicking::KickerEstimate> load_kicker_state(const std::filesystem::path& path, const Robot& robot,
                                                         std::uint32_t robot_id, double max_age_h,
                                                         std::chrono::system_clock::time_point now);

/// Writes it, whole or not at all. Throws Error naming the file.
void save_kicker_state(const std::filesystem::path& path, const kicking::KickerEstimate& estimate, const Robot& robot,
                       std::uint32_t robot_id, std::chrono::system_clock::time_point now);

/// Renames a file that was refused, since the next estimate is written to its place: to `path`.refused, or the first of
/// `path`.refused-2, -3 and so on that is not there. Returns the new name. Throws Error naming the file.
std::filesystem::path set_kicker_state_aside(const std::filesystem::path& path);

}  // namespace trivela::config
