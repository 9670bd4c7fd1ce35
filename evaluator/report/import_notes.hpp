#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "evaluator/log/queries.hpp"

namespace trivela::evaluator {

/// By session_id of an imported session: sentences on what it was imported from.
using ImportNotes = std::map<std::int64_t, std::vector<std::string>>;

/// Of the sessions whose configuration begins with log::kImportMark. Throws std::runtime_error where it cannot be read.
ImportNotes import_notes_of(const log::Queries& reader);

}  // namespace trivela::evaluator
