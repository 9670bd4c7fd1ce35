#include "evaluator/sessions/session_facts.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <set>
#include <sstream>
#include <tuple>

#include "log/schema/session.hpp"
#include "log/write/additions.hpp"

namespace trivela::evaluator {
namespace {

constexpr std::string_view kScenario = "\n### scenario\n";
constexpr std::array<std::string_view, 7> kInCharge{
    "policy_by_half = ",  "policy_by_robot = ", "random = ",      "random_probabilities = ",
    "assignment_seed = ", "shadows = ",         "half_minutes = "};

std::string without_who_is_in_charge(const std::string& settings) {
  std::istringstream lines{settings};
  std::string rest;
  for (std::string line; std::getline(lines, line);) {
    const auto begins = [&](std::string_view key) { return line.starts_with(key); };
    if (std::ranges::none_of(kInCharge, begins)) rest += line + "\n";
  }
  return rest;
}

}  // namespace

SessionSetup SetupIndex::of(const std::string& config) {
  const auto number = [](Numbers& numbers, const std::string& text) {
    return numbers.try_emplace(text, static_cast<std::uint32_t>(numbers.size())).first->second;
  };
  const auto scenario = std::min(config.find(kScenario), config.size());
  return {number(worlds_, config.substr(scenario)),
          number(settings_, without_who_is_in_charge(config.substr(0, scenario)))};
}

LoggedPitch pitch_of(std::string_view config) {
  LoggedPitch pitch;
  const std::map<std::string, double*, std::less<>> keys{{"[goal]y_m", &pitch.goal.y_m},
                                                         {"[goal]half_width_m", &pitch.goal.half_width_m},
                                                         {"[goal]height_m", &pitch.goal.height_m},
                                                         {"[goal]post_width_m", &pitch.goal.post_width_m},
                                                         {"[field]side_line_x_m", &pitch.side_line_x_m}};
  std::string table;
  while (!config.empty()) {
    const std::string_view line = config.substr(0, config.find('\n'));
    config.remove_prefix(std::min(line.size() + 1, config.size()));
    if (line.starts_with("### ") && !line.starts_with("### settings")) break;  // robots, a scenario
    if (line.starts_with("[")) table = line;
    const auto sign = line.find(" = ");
    if (sign == std::string_view::npos) continue;
    const auto key = keys.find(table + std::string(line.substr(0, sign)));
    if (key == keys.end()) continue;
    const std::string_view value = line.substr(sign + 3);
    std::from_chars(value.data(), value.data() + value.size(), *key->second);
  }
  return pitch;
}

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
