#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "log/read/reader.hpp"
#include "log/schema/queries.hpp"

namespace trivela::evaluator {

/// What somebody said of a session: a row of table `notes`.
struct SessionNote {
  std::int64_t session_id = 0;
  std::string uuid;
  std::string kind;         ///< match, opponent, venue, note
  std::int64_t utc_ns = 0;  ///< UTC since 1970
  std::string who;
  std::optional<std::string> text;  ///< none: what was said before is withdrawn
  bool holds = false;  ///< nothing later takes its place: another match, opponent or venue, or a withdrawal
};

/// By session, kind and time. Throws std::runtime_error where the log cannot be read.
std::vector<SessionNote> session_notes(const log::Reader& reader);

/// Those that hold, match, opponent and venue first; what is said of several sessions alike once.
std::vector<SessionNote> notes_that_hold(const std::vector<SessionNote>& notes);

/// "Opponent: Them", "Note of Ada, 2026-11-24 09:30 UTC: the left goal post leans".
std::string line_of(const SessionNote& note);

/// By session_id of an imported session: sentences on what it was imported from.
using ImportNotes = std::map<std::int64_t, std::vector<std::string>>;

/// Of the sessions whose configuration begins with log::kImportMark. Throws std::runtime_error where it cannot be read.
ImportNotes import_notes_of(const log::Queries& reader);

}  // namespace trivela::evaluator
