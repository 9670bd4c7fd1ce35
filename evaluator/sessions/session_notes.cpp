#include "evaluator/sessions/session_notes.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <sstream>
#include <tuple>

#include "log/schema/session.hpp"
#include "log/write/additions.hpp"

namespace trivela::evaluator {

std::vector<SessionNote> session_notes(const log::Reader& reader) {
  using N = SessionNote;
  auto notes = reader.rows<N>(
      "SELECT n.session_id, coalesce(s.uuid, ''), n.kind, n.utc_ns, n.who, n.text FROM notes AS n LEFT JOIN sessions "
      "AS s ON s.session_id = n.session_id ORDER BY s.started_t_ns, n.session_id, n.kind, n.utc_ns, n.who",
      &N::session_id, &N::uuid, &N::kind, &N::utc_ns, &N::who, &N::text);
  // From the latest on: what has the last word of its session and kind, and of notes what comes after a withdrawal.
  std::set<std::pair<std::int64_t, std::string>> settled;
  for (auto note = notes.rbegin(); note != notes.rend(); ++note) {
    const bool is_settled = settled.contains({note->session_id, note->kind});
    note->holds = note->text && !is_settled;
    if (!note->text || note->kind != "note") settled.emplace(note->session_id, note->kind);
  }
  return notes;
}

std::vector<SessionNote> notes_that_hold(const std::vector<SessionNote>& notes) {
  const auto place = [](const SessionNote& note) { return std::ranges::find(log::kNoteKinds, note.kind); };
  std::set<std::tuple<std::string, std::string, std::string>> said;
  std::vector<SessionNote> held;
  for (const SessionNote& note : notes)
    if (note.holds && said.emplace(note.uuid, note.kind, *note.text).second) held.push_back(note);
  std::ranges::stable_sort(held, {}, [&](const SessionNote& note) { return std::pair(place(note), note.utc_ns); });
  return held;
}

std::string line_of(const SessionNote& note) {
  const std::string of = note.uuid.empty() ? "" : fmt::format("{:.8} ", note.uuid);
  const std::string text = note.text.value_or("(withdrawn)");
  if (note.kind == "match") return of + "Match: " + text;
  if (note.kind == "opponent") return of + "Opponent: " + text;
  if (note.kind == "venue") return of + "Venue: " + text;
  const std::chrono::sys_time<std::chrono::nanoseconds> at{std::chrono::nanoseconds{note.utc_ns}};
  return fmt::format("{}Note of {}, {:%Y-%m-%d %H:%M} UTC: {}", of, note.who,
                     fmt::gmtime(std::chrono::floor<std::chrono::seconds>(at)), text);
}

ImportNotes import_notes_of(const log::Queries& reader) {
  ImportNotes notes;
  reader.query(
      "SELECT s.session_id, t.text FROM sessions AS s JOIN texts AS t ON t.sha256 = s.config_sha256 WHERE s.session_id "
      "IN (SELECT session_id FROM imported_sessions) ORDER BY s.session_id",
      [&](std::int64_t session_id, const std::string& text) {
        std::istringstream lines(text.substr(log::kImportMark.size()));
        auto& sentences = notes[session_id];
        for (std::string line; std::getline(lines, line) && !line.empty();) sentences.push_back(line);
      });
  return notes;
}

}  // namespace trivela::evaluator
