#pragma once

#include <filesystem>
#include <string>

#include "evaluator/export/export_plan.hpp"

namespace trivela::evaluator {

/// A cell as CSV (RFC 4180): a number as the shortest decimal that is read back to the same bits, NULL as nothing, the
/// empty text as "" in quotes, so that the two differ, another text as csv_text().
void append_csv_cell(std::string& line, const log::Value& cell);

/// Writes STREAM.csv into a new folder for each stream that has rows: names of the columns, which say the units, then
/// the rows by session, robot and number. In memory is one piece of a file. Throws BadExport as tables_of() and
/// sessions_of(), ExportStopped, std::runtime_error naming what cannot be read or written.
ExportedRows export_csv(const log::Reader& reader, const ExportPlan& plan, const std::filesystem::path& folder,
                        const ExportProgress& progress = {});

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
