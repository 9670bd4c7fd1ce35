#include "evaluator/sessions/merge_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "evaluator/render/text_table.hpp"
#include "evaluator/sessions/log_sessions.hpp"
#include "evaluator/sessions/recording_gaps.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::evaluator {
namespace {

using KickSet = std::set<std::tuple<std::int64_t, int, std::int64_t>>;  // session of an experiment or 0, robot, kick_id

using KickKeys = std::map<std::int64_t, KickSet>;  // by session

KickKeys kicks_of(const log::Reader& reader) {
  KickKeys kicks;
  reader.query(
      "SELECT k.session_id, iif(s.match_id IS NULL, 0, s.session_id), k.robot_id, k.kick_id FROM kicks AS k JOIN "
      "sessions AS s ON s.session_id = k.session_id",
      [&](std::int64_t session_id, std::int64_t of_experiment, int robot_id, std::int64_t kick_id) {
        kicks[session_id].emplace(of_experiment, robot_id, kick_id);
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
    if (const auto there = kicks.find(part.session_id); there != kicks.end())
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

constexpr double kLongestPause_s = 1.0;  // between a recording and the one that goes on from it

using RobotOfSession = std::map<std::int64_t, int>;

RobotOfSession robots_of(const log::Merged& merged) {
  RobotOfSession robots;
  for (const log::MergedSession& session : merged.sessions) robots[session.clock.session_id] = session.clock.robot_id;
  return robots;
}

void add_damage(const log::Merged& merged, std::vector<std::string>& lines) {
  for (const log::MergedFile& file : merged.files) {
    if (file.damage.empty()) continue;
    lines.push_back(file.readable ? file.damage + "; what could be read was taken"
                                  : file.damage + "; nothing of it was taken");
  }
  for (const log::MergedSession& session : merged.sessions) {
    if (session.is_whole) continue;
    lines.push_back(
        fmt::format("session {} of {} was never closed: {}", session.clock.uuid, participant(session.clock.robot_id),
                    session.missing_rows > 0
                        ? fmt::format("{} rows that its recorder had written are not there", session.missing_rows)
                        : "what its recorder had not yet written is not there"));
  }
}

void add_losses(const log::Reader& reader, const RobotOfSession& robots, std::vector<std::string>& lines) {
  reader.query(
      "SELECT session_id, stream, max(lost, gaps) + overflow + nan_refused + rejected FROM losses WHERE robot_id = 0 "
      "AND max(lost, gaps) + overflow + nan_refused + rejected > 0 ORDER BY session_id, stream",
      [&](std::int64_t session_id, const std::string& stream, std::int64_t rows) {
        const auto robot = robots.find(session_id);
        lines.push_back(fmt::format("{}: {} row{} of {} were lost while it was recorded",
                                    participant(robot == robots.end() ? 0 : robot->second), rows, rows == 1 ? "" : "s",
                                    stream));
      });
}

void add_pauses(const log::Merged& merged, const log::Reader& reader, const RobotOfSession& robots,
                std::vector<std::string>& lines) {
  std::map<std::string, const log::ClockedSession*> by_uuid;
  for (const log::MergedSession& session : merged.sessions) by_uuid[session.clock.uuid] = &session.clock;
  reader.query(
      "SELECT session_id, started_t_ns + utc_offset_ns, continues_uuid FROM sessions JOIN utc_offsets USING "
      "(session_id) WHERE continues_uuid IS NOT NULL ORDER BY session_id",
      [&](std::int64_t session_id, std::int64_t started_utc_ns, const std::string& continues_uuid) {
        const auto before = by_uuid.find(continues_uuid);
        const std::string who = participant(robots.at(session_id));
        if (before == by_uuid.end()) {
          lines.push_back(fmt::format("{}: a session goes on from {}, which no file has", who, continues_uuid));
          return;
        }
        reader.query(
            fmt::format("SELECT utc_offset_ns FROM utc_offsets WHERE session_id = {}", before->second->session_id),
            [&](std::int64_t utc_offset_ns) {
              const double pause_s = kicking::seconds(started_utc_ns - before->second->ended_t_ns - utc_offset_ns);
              if (pause_s <= kLongestPause_s) return;
              lines.push_back(fmt::format("{}: its recorder was gone for {:.1f} s before it went on", who, pause_s));
            });
      });
}

/// Kicks of a robot that other sessions have a receipt of, from the time in which this session lacks them.
std::int64_t kicks_elsewhere(const log::Reader& reader, const UnrecordedOrders& orders) {
  std::int64_t kicks = 0;
  reader.query(
      fmt::format(
          "WITH status AS (SELECT session_id, t_ns FROM kicker_status WHERE robot_id = {0}) SELECT count(DISTINCT "
          "kick_id) FROM kick_receipts WHERE robot_id = {0} AND accepted = 1 AND session_id <> {1} AND kick_id NOT IN "
          "(SELECT kick_id FROM kick_receipts WHERE session_id = {1} AND robot_id = {0}) AND t_ns <= (SELECT max(t_ns) "
          "FROM status WHERE session_id = {1}) AND t_ns > coalesce((SELECT max(t_ns) FROM status WHERE session_id = "
          "(SELECT p.session_id FROM sessions AS p JOIN sessions AS s ON s.continues_uuid = p.uuid WHERE s.session_id "
          "= {1})), (SELECT min(t_ns) FROM status WHERE session_id = {1}))",
          orders.robot_id, orders.session_id),
      [&](std::int64_t found) { kicks = found; });
  return kicks;
}

void add_missing_kicks(const log::Reader& reader, std::vector<std::string>& lines) {
  for (const UnrecordedOrders& orders : unrecorded_orders_of(reader)) {
    if (!orders.counts()) continue;
    const std::int64_t counted = orders.kicks_within + (orders.continues ? orders.kicks_before : 0);
    const std::int64_t kicks = counted - std::min(counted, kicks_elsewhere(reader, orders));
    if (kicks > 0) {
      lines.push_back(fmt::format("robot {}: {} {} that its driver counted {} in no file", orders.robot_id, kicks,
                                  kicks == 1 ? "kick" : "kicks", kicks == 1 ? "is" : "are"));
    }
    if (orders.continues && orders.restarted_before)
      lines.push_back(fmt::format(
          "robot {}: its driver was started again while nobody recorded, what it did before that is not known",
          orders.robot_id));
  }
}

std::vector<std::string> merge_gaps(const log::Merged& merged, const log::Reader& reader) {
  const RobotOfSession robots = robots_of(merged);
  std::vector<std::string> lines;
  add_damage(merged, lines);
  add_losses(reader, robots, lines);
  std::vector<RecordedSilence> silences = silences_of(reader);
  std::erase_if(silences, [](const RecordedSilence& silence) { return !silence.counts; });
  for (std::string& line : silence_lines(silences)) lines.push_back(std::move(line));
  add_pauses(merged, reader, robots, lines);
  add_missing_kicks(reader, lines);
  return lines;
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

std::string participant(int robot_id) { return robot_id == 0 ? "the base" : fmt::format("robot {}", robot_id); }

}  // namespace trivela::evaluator
