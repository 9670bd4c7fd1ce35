#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "kicking/lob/analyzer.hpp"
#include "kicking/lob/lob_record.hpp"
#include "log/write/scan_log.hpp"

namespace trivela::calibration {

/// Gives a lob the power of the last set-point at or before its launch, and the last verdict on it: a verdict is on the
/// lob whose launch is within half a second of its own, since another fit gives another instant. Rejected:
/// Refusal::kOperator with the human's words. Accepted: the refusal is lifted where there are effective values, and
/// stays where there are none. Verdicts in the order they were said.
void annotate(kicking::lob::LobRecord& lob, std::span<const log::TestedSetPoint> set_points,
              std::span<const log::Verdict> verdicts);

/// The lobs of a scan record in the order of their flights, refused ones too, each with its power and the verdicts of
/// the record; `later_verdicts`, said of a finished record and kept beside it, come after those.
/// Throws std::runtime_error where the record cannot be read, std::invalid_argument where its geometry makes no sense.
std::vector<kicking::lob::LobRecord> lobs_of_scans(const log::ScanReader& scans,
                                                   const kicking::lob::AnalyzerConfig& config = {},
                                                   std::span<const log::Verdict> later_verdicts = {});

/// Verdicts on the lobs of a finished record, which is never changed, stand in RECORD.verdicts.json beside it: a list
/// of
/// {"launch_t_ns", "accepted", "why"} in the order they were said.
std::filesystem::path verdicts_path(const std::filesystem::path& record);

/// Empty where there is no such file. Throws std::runtime_error naming a file that is something else.
std::vector<log::Verdict> verdicts_beside(const std::filesystem::path& record);

/// Replaces the file as a whole. Throws std::runtime_error naming the file that cannot be written.
void write_verdicts(const std::filesystem::path& record, std::span<const log::Verdict> verdicts);

}  // namespace trivela::calibration
