#pragma once

#include <filesystem>
#include <string>

#include "evaluator/export/export_plan.hpp"

namespace trivela::evaluator {

/// A cell as CSV (RFC 4180): a number as the shortest decimal that is read back to the same bits, NULL as nothing, the
/// empty text as "" in quotes, so that the two differ.
void append_csv_cell(std::string& line, const log::Value& cell);

/// Writes STREAM.csv into a new folder for each stream that has rows: names of the columns, which say the units, then
/// the rows by session, robot and number. In memory is one piece of a file. Throws BadExport as tables_of() and
/// sessions_of(), ExportStopped, std::runtime_error naming what cannot be read or written.
ExportedRows export_csv(const log::Reader& reader, const ExportPlan& plan, const std::filesystem::path& folder,
                        const ExportProgress& progress = {});

}  // namespace trivela::evaluator
