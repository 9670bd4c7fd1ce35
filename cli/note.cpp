#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/log/additions.hpp"
#include "evaluator/log/reader.hpp"
#include "evaluator/report/session_notes.hpp"

namespace trivela::cli {
namespace {

struct NoteArguments {
  std::string log;
  std::string match, opponent, venue, text;
  std::string withdraw;
  std::string who;
  std::string session;
};

/// What was said, each kind once.
std::vector<evaluator::log::Note> said(const NoteArguments& arguments) {
  std::vector<evaluator::log::Note> notes;
  const auto say_of = [&](const char* kind, const std::string& text) {
    if (!text.empty()) notes.push_back({.session_id = 0, .kind = kind, .text = text, .who = arguments.who});
  };
  say_of("match", arguments.match);
  say_of("opponent", arguments.opponent);
  say_of("venue", arguments.venue);
  say_of("note", arguments.text);
  if (!arguments.withdraw.empty())
    notes.push_back({.session_id = 0, .kind = arguments.withdraw, .text = std::nullopt, .who = arguments.who});
  return notes;
}

int list_notes(const NoteArguments& arguments) {
  const evaluator::log::Reader reader(arguments.log);
  const auto notes = evaluator::session_notes(reader);
  for (const evaluator::SessionNote& note : notes) {
    if (!note.uuid.starts_with(arguments.session)) continue;
    say(fmt::format("{:.8} {}{}{}\n", note.uuid, evaluator::line_of(note),
                    note.kind == "note" ? "" : fmt::format(" ({})", note.who), note.holds ? "" : " - no longer holds"));
  }
  if (notes.empty()) say("nobody has noted anything\n");
  return kDone;
}

/// Where nothing of the kind holds there is nothing to withdraw.
void require_something_to_withdraw(const NoteArguments& arguments, const evaluator::log::Reader& reader) {
  if (arguments.withdraw.empty()) return;
  const auto notes = evaluator::session_notes(reader);
  if (std::ranges::any_of(notes, [&](const evaluator::SessionNote& note) {
        return note.kind == arguments.withdraw && note.holds && note.text && note.uuid.starts_with(arguments.session);
      }))
    return;
  throw std::runtime_error{
      fmt::format("{}: no {} is noted that holds: nothing is withdrawn", arguments.log, arguments.withdraw)};
}

/// Those that are meant; throws std::runtime_error where there is none, or nothing to withdraw.
std::vector<std::int64_t> sessions_of(const NoteArguments& arguments) {
  std::vector<std::int64_t> sessions;
  const evaluator::log::Reader reader(arguments.log);
  for (const evaluator::log::RecordedSession& session : reader.sessions())
    if (session.uuid.starts_with(arguments.session)) sessions.push_back(session.session_id);
  if (sessions.empty())
    throw std::runtime_error{fmt::format("{} has no session that begins with '{}'", arguments.log, arguments.session)};
  require_something_to_withdraw(arguments, reader);
  return sessions;
}

int add_notes(const NoteArguments& arguments, std::vector<evaluator::log::Note> notes) {
  const std::vector<std::int64_t> sessions = sessions_of(arguments);
  evaluator::log::Additions additions(arguments.log);
  const auto now_utc_ns = std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
  for (evaluator::log::Note& note : notes) {
    for (const std::int64_t session_id : sessions) {
      note.session_id = session_id;
      additions.add(note, now_utc_ns);
    }
  }
  say(fmt::format("{}: noted of {} session{}\n", arguments.log, sessions.size(), sessions.size() == 1 ? "" : "s"));
  return kDone;
}

}  // namespace

void add_note(CLI::App& app, int& exit_code) {
  auto* const verb =
      app.add_subcommand("note", "Say in a log which match it is, against whom, where, and what to know");
  verb->footer(
      "Each is a row of its own with who and when; nothing is changed or removed. Of match, opponent and venue the\n"
      "latest holds, notes stand beside each other; the report shows what holds. Without anything to say: what was "
      "said.");
  const auto arguments = std::make_shared<NoteArguments>();
  verb->add_option("log", arguments->log, "Match log of this version (trivela migrate)")->required();
  verb->add_option("text", arguments->text, "A note, in quotes");
  verb->add_option("--match", arguments->match, "Which match it is, such as \"semi-final\"");
  verb->add_option("--opponent", arguments->opponent, "Against whom");
  verb->add_option("--venue", arguments->venue, "Where");
  verb->add_option("--withdraw", arguments->withdraw,
                   "What was said of this no longer holds: match, opponent, venue, note")
      ->check(CLI::IsMember(
          std::vector<std::string>(evaluator::log::kNoteKinds.begin(), evaluator::log::kNoteKinds.end())));
  verb->add_option("--by", arguments->who, "Who says so");
  verb->add_option("--session", arguments->session, "How the uuid of the session begins; default: all of the log");
  verb->callback([arguments, &exit_code] {
    auto notes = said(*arguments);
    if (notes.empty() && !arguments->who.empty()) throw UsageError{"say what is to be noted"};
    if (!notes.empty() && arguments->who.empty()) throw UsageError{"--by WHO: who says so?"};
    exit_code = notes.empty() ? list_notes(*arguments) : add_notes(*arguments, std::move(notes));
  });
}

}  // namespace trivela::cli
