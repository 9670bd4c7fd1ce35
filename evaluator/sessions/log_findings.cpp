#include "evaluator/sessions/log_findings.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <exception>
#include <utility>

#include "evaluator/sessions/label_quality.hpp"
#include "evaluator/sessions/log_sessions.hpp"
#include "evaluator/sessions/recording_gaps.hpp"
#include "log/file/files_beside.hpp"
#include "log/file/new_file.hpp"
#include "log/merge/merge_source.hpp"
#include "log/schema/refused_log.hpp"

namespace trivela::evaluator {
namespace {

namespace fs = std::filesystem;

using Findings = std::vector<LogFinding>;

/// One finding a sentence, or that there is none.
void add_finding(Findings& findings, const char* check, const std::vector<std::string>& sentences,
                 const std::string& advice, const std::string& well) {
  for (const std::string& sentence : sentences) findings.push_back({check, Health::kDoubtful, sentence, advice});
  if (sentences.empty()) findings.push_back({check, Health::kOk, well, ""});
}

void look_at_wal(const fs::path& path, log::Wal of_whom, Findings& findings) {
  const std::string wal = log::beside(path, "-wal").filename().string();
  switch (of_whom) {
    case log::Wal::kNone:
      return findings.push_back({"-wal", Health::kOk, "none is left behind", ""});
    case log::Wal::kOfAnother:
      return findings.push_back({"-wal", Health::kDoubtful,
                                 wal + " is of another recording, or an older copy: it was left out",
                                 fmt::format("move {} away; never merge the two", wal)});
    case log::Wal::kOfThis:
      break;
  }
  std::error_code none;
  findings.push_back({"-wal", Health::kDoubtful,
                      fmt::format("{} of {} bytes lies beside it: its recorder runs, or was killed", wal,
                                  fs::file_size(log::beside(path, "-wal"), none)),
                      "copy both files together, never the log alone; trivela merge makes one file of the two"});
}

void look_at_sessions(const log::Reader& reader, Findings& findings) {
  std::vector<std::string> open;
  const auto sessions = reader.sessions();
  for (const log::RecordedSession& session : sessions) {
    if (!session.closed_t_ns)
      open.push_back(fmt::format("session {} of {} was never closed: {}", session.uuid,
                                 session.robot_id ? fmt::format("robot {}", *session.robot_id) : "the base",
                                 reader.not_closed()));
  }
  add_finding(findings, "sessions", open,
              "look for the rest: the folder where the recorder went on, /var/lib/trivela, /var/tmp, /dev/shm, other "
              "robots' logs; then trivela merge",
              fmt::format("{}, closed", sessions.size()));
}

void look_for_gaps(const log::Reader& reader, Findings& findings) {
  std::vector<std::string> lost;
  std::int64_t rows = 0;
  for (const log::Loss& loss : reader.losses()) {
    rows += loss.received;
    if (loss.missing() > 0) lost.push_back(fmt::format("{}: {} rows are missing", loss.stream, loss.missing()));
  }
  add_finding(
      findings, "rows", lost,
      "another recorder may have them: trivela merge; where they went: the columns of table losses, trivela report",
      fmt::format("{} were received and none is missing", rows));
  std::vector<RecordedSilence> silences = silences_of(reader);
  std::erase_if(silences, [](const RecordedSilence& silence) { return !silence.counts; });
  add_finding(findings, "silences", silence_lines(silences),
              "a node or its network was away: its own log, trivela doctor --network, trivela top while it runs",
              "no stream fell silent");
  std::vector<UnrecordedOrders> orders = unrecorded_orders_of(reader);
  std::erase_if(orders, [](const UnrecordedOrders& of) { return !of.counts(); });
  add_finding(findings, "orders", order_lines(orders), "the kicks count in no table: merge the log that has them",
              "every order that a driver counted is there");
}

void look_at_lengths(const log::Reader& reader, Findings& findings) {
  SessionIndex sessions_read;
  sessions_read.add(reader, "this log");
  sessions_read.settle();
  const std::array<const log::Reader*, 1> readers{&reader};
  const auto lengths = played_lengths(readers, sessions_read.sessions());
  add_finding(findings, "length", cut_short_lines(lengths),
              "compare counts what was played; play it again, or merge the rest",
              lengths.empty() ? "nobody planned one" : "as planned");
}

void look_at_goal(const log::Reader& reader, Findings& findings) {
  const LabelQuality quality = label_quality_of(reader);
  add_finding(
      findings, "goal line", quality.goal_warnings(),
      "measure from the centre spot to the goal line, set goal.y_m; label the kicks by hand until then (trivela label)",
      quality.turns_at_goal > 0
          ? fmt::format("{} ball{} came back from it", quality.turns_at_goal, quality.turns_at_goal == 1 ? "" : "s")
          : std::string("no ball came back from anywhere else"));
  add_finding(findings, "release", quality.release_warnings(),
              "trivela calibrate run measures the delay; policies that turn aim beside the goal until then",
              quality.releases.empty() ? "no flight shows it" : "when the robots' files expect it");
}

/// Without who says more: that is this.
std::string found_by(const std::exception& error) {
  const auto* const refused = dynamic_cast<const log::RefusedLog*>(&error);
  return refused ? refused->found() : error.what();
}

void look_at_clocks(const log::Reader& reader, Findings& findings) {
  for (LogFinding& found : clock_findings(reader)) findings.push_back(std::move(found));
}

struct Look {
  const char* check;
  void (*look_at)(const log::Reader& reader, Findings& findings);
};
constexpr Look kLooks[] = {{"sessions", look_at_sessions},
                           {"rows", look_for_gaps},
                           {"length", look_at_lengths},
                           {"goal line", look_at_goal},
                           {"clock", look_at_clocks}};

/// What reading says where it fails is a finding like any other.
void look(const Look& at, const log::Reader& reader, Findings& findings) try {
  at.look_at(reader, findings);
} catch (const std::exception& error) {
  findings.push_back({at.check, Health::kBad, found_by(error), "trivela merge NEW.db LOG takes what can be read"});
}

/// What to do about a file that does not open.
std::string advice_on(log::Refused why) {
  constexpr std::array kAdvice{
      "match logs are SQLite files that a recorder or trivela simulate has written",
      "nothing is in it; copy it again if it was copied",
      "read it with the Trivela that wrote it",
      "drop the index; labels and notes need none",
      "trivela merge NEW.db LOG counts them again",
      "trivela merge NEW.db LOG takes what can be read, other recorders' logs the rest; copy the file again if it was "
      "copied"};  // in the order of Refused
  static_assert(kAdvice.size() == static_cast<std::size_t>(log::Refused::kDamaged) + 1);
  return kAdvice.at(static_cast<std::size_t>(why));
}

}  // namespace

std::vector<LogFinding> examine_log(const fs::path& path) {
  Findings findings;
  try {
    const log::Reader reader(path, log::Check::kWhole);
    const auto doubt = reader.doubt();
    findings.push_back({"file", Health::kOk, fmt::format("a match log of version {}", log::kMatchLog.version), ""});
    findings.push_back({"integrity", Health::kOk,
                        doubt ? *doubt : fmt::format("{} rows are as they were recorded", reader.verification().rows),
                        ""});
    look_at_wal(path, reader.wal(), findings);
    for (const Look& each : kLooks) look(each, reader, findings);
  } catch (const std::exception& error) {
    const auto* const refused = dynamic_cast<const log::RefusedLog*>(&error);
    findings.push_back(
        {"file", Health::kBad, found_by(error), advice_on(refused ? refused->why() : log::Refused::kDamaged)});
    if (fs::is_regular_file(path)) look_at_wal(path, log::wal_beside(path), findings);
  }
  return findings;
}

std::vector<LogFinding> compare_logs(const std::vector<fs::path>& paths) {
  log::KickConflicts claims;
  for (const fs::path& path : paths) claims.add(log::MergeSource(path));
  std::vector<std::string> conflicts;
  for (const log::KickConflict& conflict : claims.conflicts()) conflicts.push_back(conflict.line());
  Findings findings;
  add_finding(
      findings, "conflicts", conflicts,
      "look at the kick (trivela label) and say what became of it: a label by hand counts before all recordings",
      "the logs say the same of every kick that several have");
  return findings;
}

}  // namespace trivela::evaluator
