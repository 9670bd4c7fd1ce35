#pragma once

#include <filesystem>
#include <string>

#include "evaluator/export/export_plan.hpp"

namespace trivela::evaluator {

/// Sessions that one MCAP file may have: they lie on one axis of time and are read at once.
inline constexpr std::size_t kMostSessionsOfMcap = 64;

/// Writes the log as MCAP in the order of time, by UTC as merging found it out: each row as a message of its own type
/// (evaluator/mcap/row_message.hpp) on /robot_N/STREAM, or /log/STREAM where it is no robot's, beside it the scene
/// (evaluator/export/match_scene.hpp) and each session's configuration as metadata. Rows without an instant stand at
/// their session's begin. Where two sessions have rows of one robot at one time, topics begin with /session_UUID. The
/// same log and `library` (who writes) make the same bytes. Throws as export_csv(), BadExport
/// where there are more sessions than kMostSessionsOfMcap.
ExportedRows export_mcap(const log::Reader& reader, const ExportPlan& plan, const std::filesystem::path& file,
                         const std::string& library, const ExportProgress& progress = {});

}  // namespace trivela::evaluator
