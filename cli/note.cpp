#include <fmt/format.h>

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/sessions/session_facts.hpp"
#include "kicking/text/printable.hpp"
#include "log/read/reader.hpp"
#include "log/write/additions.hpp"

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
std::vector<log::Note> said(const NoteArguments& arguments) {
  std::vector<log::Note> notes;
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
  const log::Reader reader(arguments.log);
  const auto notes = evaluator::session_notes(reader);
  for (const evaluator::SessionNote& note : notes) {
    if (!note.uuid.starts_with(arguments.session)) continue;
    say(fmt::format("{}{}{}\n", kicking::printable(evaluator::line_of(note)),
                    note.kind == "note" ? "" : fmt::format(" ({})", kicking::printable(note.who)),
                    note.holds ? "" : " - no longer holds"));
  }
  if (notes.empty()) say("nobody has noted anything\n");
  return kDone;
}

/// Sessions that are meant, and those of them in which something holds of the kind that is withdrawn.
struct Meant {
  std::vector<std::int64_t> all;
  std::set<std::int64_t> to_withdraw;
};

/// Throws UsageError where no session is meant, std::runtime_error where nothing is to be withdrawn.
Meant sessions_meant(const NoteArguments& arguments) {
  Meant meant;
  const log::Reader reader(arguments.log);
  for (const log::RecordedSession& session : reader.sessions())
    if (session.uuid.starts_with(arguments.session)) meant.all.push_back(session.session_id);
  if (meant.all.empty())
    throw UsageError{fmt::format("{} has no session that begins with '{}'", arguments.log, arguments.session)};
  if (arguments.withdraw.empty()) return meant;
  for (const evaluator::SessionNote& note : evaluator::session_notes(reader))
    if (note.kind == arguments.withdraw && note.holds && note.text && note.uuid.starts_with(arguments.session))
      meant.to_withdraw.insert(note.session_id);
  if (meant.to_withdraw.empty())
    throw std::runtime_error{fmt::format("{}: no {} is noted that holds{}: nothing is written", arguments.log,
                                         arguments.withdraw,
                                         arguments.session.empty() ? "" : " of session " + arguments.session)};
  return meant;
}

int add_notes(const NoteArguments& arguments, std::vector<log::Note> notes) {
  const Meant meant = sessions_meant(arguments);
  log::Additions additions(arguments.log);
  const std::int64_t now_utc_ns = log::utc_now_ns();
  std::set<std::int64_t> noted;
  for (log::Note& note : notes) {
    for (const std::int64_t session_id : meant.all) {
      if (!note.text && !meant.to_withdraw.contains(session_id)) continue;
      note.session_id = session_id;
      additions.add(note, now_utc_ns);
      noted.insert(session_id);
    }
  }
  say(fmt::format("{}: noted of {} session{}\n", arguments.log, noted.size(), noted.size() == 1 ? "" : "s"));
  return kDone;
}

int run_note(const NoteArguments& arguments) {
  auto notes = said(arguments);
  if (notes.empty() && !arguments.who.empty()) throw UsageError{"say what is to be noted"};
  if (!notes.empty() && arguments.who.empty()) throw UsageError{"--by WHO: who says so?"};
  return notes.empty() ? list_notes(arguments) : add_notes(arguments, std::move(notes));
}

}  // namespace

void add_note(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] = add_verb(
      app, exit_code, "note", "Say in a log which match it is, against whom, where, and what to know", run_note);
  verb->footer(
      R"(Each is a row of its own with who and when; nothing is changed or removed. Of match, opponent and venue the
latest holds, notes stand beside each other; the report shows what holds. Without anything to say: what was said.)");
  verb->add_option("log", arguments->log, "Match log")->required();
  verb->add_option("text", arguments->text, "A note, in quotes");
  verb->add_option("--match", arguments->match, "Which match it is, such as \"semi-final\"");
  verb->add_option("--opponent", arguments->opponent, "Against whom");
  verb->add_option("--venue", arguments->venue, "Where");
  verb->add_option("--withdraw", arguments->withdraw,
                   "What was said of this no longer holds: match, opponent, venue, note")
      ->check(CLI::IsMember(std::vector<std::string>(log::kNoteKinds.begin(), log::kNoteKinds.end())));
  verb->add_option("--by", arguments->who, "Who says so");
  verb->add_option("--session", arguments->session, "How the uuid of the session begins; default: all of the log");
}

}  // namespace trivela::cli
