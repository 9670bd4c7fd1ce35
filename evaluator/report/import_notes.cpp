#include "evaluator/report/import_notes.hpp"

#include <sstream>

#include "evaluator/log/session.hpp"

namespace trivela::evaluator {

ImportNotes import_notes_of(const log::Queries& reader) {
  ImportNotes notes;
  reader.query(
      "SELECT s.session_id, t.text FROM sessions AS s JOIN texts AS t ON t.sha256 = s.config_sha256 "
      "WHERE s.session_id IN (SELECT session_id FROM imported_sessions) ORDER BY s.session_id",
      [&](std::int64_t session_id, const std::string& text) {
        std::istringstream lines(text.substr(log::kImportMark.size()));
        auto& sentences = notes[session_id];
        for (std::string line; std::getline(lines, line) && !line.empty();) sentences.push_back(line);
      });
  return notes;
}

}  // namespace trivela::evaluator
