#pragma once

#include <filesystem>
#include <string>

#include "hal/range_finder.hpp"
#include "log/write/scan_log.hpp"

namespace trivela::calibration {

/// What a record of this connected scanner says about itself; the clock is the steady one. An emulator's scans are
/// marked as simulated.
log::ScanSession scanner_session(const hal::RangeFinder& finder, const kicking::lob::LaserMount& mount,
                                 const std::string& device);

/// Throws config::BadArgument where the file is there already: before a scanner has been waited for.
void refuse_existing(const std::filesystem::path& record);

}  // namespace trivela::calibration
