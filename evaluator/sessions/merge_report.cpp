#include "evaluator/sessions/merge_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "evaluator/render/text_table.hpp"
#include "evaluator/sessions/log_sessions.hpp"

namespace trivela::evaluator {
namespace {

using KickSet = std::set<std::tuple<std::int64_t, int, std::int64_t>>;  // session of an experiment or 0, robot, kick_id

struct KickKeys {
  std::map<std::int64_t, KickSet> by_session;
};

KickKeys kicks_of(const log::Reader& reader) {
  KickKeys kicks;
  reader.query(
      "SELECT k.session_id, iif(s.match_id IS NULL, 0, s.session_id), k.robot_id, k.kick_id FROM kicks AS k "
      "JOIN sessions AS s ON s.session_id = k.session_id",
      [&](std::int64_t session_id, std::int64_t of_experiment, int robot_id, std::int64_t kick_id) {
        kicks.by_session[session_id].emplace(of_experiment, robot_id, kick_id);
      });
  return kicks;
}

double in_ms(std::int64_t ns) { return 1e-6 * static_cast<double>(ns); }

/// How the clock of a session was set to the reference's.
std::string clock_words(const log::Alignment& alignment, const log::ClockedSession& session) {
  const auto found = std::ranges::find(alignment.sessions, session.session_id, &log::AlignedSession::session_id);
  if (found == alignment.sessions.end()) return "its own";
  if (session.uuid == alignment.reference_uuid) return "the reference";
  return fmt::format("{:+.3f} ms +- {:.3f} ms",
                     in_ms(found->segments.front().utc_offset_ns - session.realtime_offset_ns), in_ms(found->error_ns));
}

std::vector<std::string> file_row(const log::Merged& merged, const log::MergedFile& file, const KickKeys& kicks) {
  std::set<std::string> robots, clocks;
  KickSet its_kicks;
  std::int64_t rows = 0, added = 0;
  for (const log::MergedPart& part : file.parts) {
    rows += part.rows;
    added += part.added;
    const auto session =
        std::ranges::find(merged.sessions, part.session_id, [](const auto& s) { return s.clock.session_id; });
    if (session == merged.sessions.end()) continue;
    robots.insert(session->clock.robot_id == 0 ? "base" : std::to_string(session->clock.robot_id));
    clocks.insert(clock_words(merged.alignment, session->clock));
    if (const auto there = kicks.by_session.find(part.session_id); there != kicks.by_session.end())
      its_kicks.insert(there->second.begin(), there->second.end());
  }
  return {file.path.filename().string(),
          fmt::format("{}", fmt::join(robots, "+")),
          std::to_string(file.parts.size()),
          std::to_string(rows),
          std::to_string(added),
          std::to_string(its_kicks.size()),
          clocks.size() > 3 ? fmt::format("{} different", clocks.size()) : fmt::format("{}", fmt::join(clocks, ", "))};
}

/// Those that count once, in the whole log.
std::int64_t counted_kicks(log::Reader& reader) {
  SessionIndex sessions_read;
  const SessionPlaces places = sessions_read.add(reader, "the merged log");
  sessions_read.settle();
  reader.leave_out(sessions_read.sessions_left_out(places), sessions_read.kicks_left_out(places));
  std::int64_t kicks = 0;
  reader.query("SELECT count(*) FROM counted_kicks", [&](std::int64_t count) { kicks = count; });
  return kicks;
}

std::vector<std::string> clock_notes(const log::Merged& merged) {
  const log::Alignment& alignment = merged.alignment;
  if (!alignment.reference_robot)
    return {merged.sessions.size() > 1 ? "clocks: nobody measured them; each session's UTC is its own machine's"
                                       : "clocks: one session, nothing to align"};
  std::vector<std::string> notes{fmt::format("clocks: aligned to that of {}", participant(*alignment.reference_robot))};
  for (const log::MergedSession& session : merged.sessions) {
    const bool aligned = std::ranges::find(alignment.sessions, session.clock.session_id,
                                           &log::AlignedSession::session_id) != alignment.sessions.end();
    if (!aligned)
      notes.push_back(fmt::format("clocks: session {} of {} stays as it is, nobody measured it against the reference",
                                  session.clock.uuid, participant(session.clock.robot_id)));
  }
  return notes;
}

}  // namespace

MergeReport report_merge(const log::Merged& merged, log::Reader&& reader) {
  MergeReport report;
  const KickKeys kicks = kicks_of(reader);
  std::vector<std::vector<std::string>> rows{{"file", "robot", "sessions", "rows", "new", "kicks", "clock"}};
  std::int64_t added = 0;
  std::set<std::string> robots;
  for (const log::MergedFile& file : merged.files) {
    rows.push_back(file_row(merged, file, kicks));
    for (const log::MergedPart& part : file.parts) added += part.added;
  }
  for (const log::MergedSession& session : merged.sessions) robots.insert(participant(session.clock.robot_id));
  report.table = text_table(rows);
  report.total =
      fmt::format("{} session{} of {}: {} rows, {} kicks", merged.sessions.size(),
                  merged.sessions.size() == 1 ? "" : "s", fmt::join(robots, ", "), added, counted_kicks(reader));
  report.notes = clock_notes(merged);
  for (const log::KickConflict& conflict : merged.conflicts) report.conflicts.push_back(conflict.line());
  report.missing = merge_gaps(merged, reader);
  return report;
}

}  // namespace trivela::evaluator
