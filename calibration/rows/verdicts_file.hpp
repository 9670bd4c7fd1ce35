#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "log/write/scan_log.hpp"

namespace trivela::calibration {

/// Verdicts on the lobs of a finished record, which is never changed, stand in RECORD.verdicts.json beside it: a list
/// of
/// {"launch_t_ns", "accepted", "why"} in the order they were said.
std::filesystem::path verdicts_path(const std::filesystem::path& record);

/// Empty where there is no such file. Throws std::runtime_error naming a file that is something else.
std::vector<log::Verdict> verdicts_beside(const std::filesystem::path& record);

/// Replaces the file as a whole. Throws std::runtime_error naming the file that cannot be written.
void write_verdicts(const std::filesystem::path& record, std::span<const log::Verdict> verdicts);

}  // namespace trivela::calibration
