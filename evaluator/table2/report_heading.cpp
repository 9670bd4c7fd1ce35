#include "evaluator/table2/report_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace trivela::evaluator {
namespace {

constexpr std::size_t kMostSessions = 8;

std::size_t halves_of(const log::Session& session) {
  std::set<int> halves;
  for (const log::HalfPolicy& half : session.policies) halves.insert(half.half);
  return halves.size();
}

// ", half 1 stopped, half 2 moving"; ", robot 1 stopped, robot 2 moving" where robots have policies of their own.
std::string who_played(const std::vector<log::HalfPolicy>& policies) {
  std::map<int, std::vector<const log::HalfPolicy*>> by_robot;
  for (const log::HalfPolicy& half : policies) by_robot[half.robot_id].push_back(&half);
  std::string text;
  for (const auto& [robot_id, halves] : by_robot) {
    const bool own = robot_id != 0;
    if (own) text += fmt::format(", robot {}", robot_id);
    if (!own && by_robot.size() > 1) text += ", other robots";
    const std::string& first = halves.front()->policy;
    const bool one = std::ranges::all_of(halves, [&](auto* half) { return half->policy == first; });
    const bool alone = by_robot.size() == 1 && !own;
    if (one && !alone) text += fmt::format(" {}", first);
    for (const log::HalfPolicy* const half : halves) {
      if (!one || alone) text += fmt::format("{} half {} {}", alone ? "," : "", half->half, half->policy);
    }
  }
  return text;
}

void add_session(std::vector<std::string>& lines, const log::RecordedSession& session, const ImportNotes& imports) {
  std::string text =
      fmt::format("Session {}: {} '{}'", session.uuid, session.simulated ? "scenario" : "match", session.scenario);
  if (session.seed) text += fmt::format(", seed {}", *session.seed);
  if (session.robot_id) text += fmt::format(", robot {}", *session.robot_id);
  text += who_played(session.policies);
  lines.push_back(text +
                  fmt::format(", version {}, configuration {:.12}", session.software_version, session.config_sha256));
  if (session.paired_halves && halves_of(session) > 1)
    lines.emplace_back("  its halves are paired: each has the possessions of the first");
  if (const auto notes = imports.find(session.session_id); notes != imports.end()) {
    for (const std::string& note : notes->second) lines.push_back(fmt::format("  {}", note));
  }
  if (!session.continues_uuid.empty())
    lines.push_back(fmt::format("  it continues session {}", session.continues_uuid));
}

std::string arm_line(const Arm& arm) {
  std::string text = fmt::format("Arm {}: scenario '{}', {} {}", arm.name, arm.scenario, arm.matches,
                                 arm.matches == 1 ? "match" : "matches");
  if (arm.sessions != arm.matches) text += fmt::format(" in {} sessions", arm.sessions);
  text += arm.policies.empty() ? ", policies drawn at random" : who_played(arm.policies);
  if (!arm.table.empty()) text += fmt::format(", {} table", arm.table);
  text += fmt::format(", version {}", arm.software_version);
  return text + (arm.configurations > 1 ? fmt::format(", {} configurations", arm.configurations)
                                        : fmt::format(", configuration {:.12}", arm.config_sha256));
}

constexpr std::size_t kMostLogs = 8;

std::string logs_of(const Report& report) {
  if (report.logs.size() > kMostLogs) return fmt::format(" LOG... (these {})", report.logs.size());
  std::string text;
  for (const std::string& log : report.logs) text += " " + shell_word(log);
  return text;
}

// ", by these counts alone: ..." of two policies.
std::string counts_of(const Report& report) {
  if (report.policies.size() != 2) return "";
  std::string text = "; by these counts alone: trivela compare --counts";
  for (const PolicyRow& row : report.policies) {
    if (row.counts().n == 0) return "";
    text += fmt::format(" {}", shell_word(fmt::format("{}={}/{}", row.policy, row.counts().inside, row.counts().n)));
  }
  return text;
}

}  // namespace

std::vector<std::string> heading_of(const Report& report) {
  const auto simulated = report.simulated_sessions();
  std::vector<std::string> lines;
  if (simulated > 0) {
    lines.emplace_back("SIMULATED MATCH: the numbers describe the simulation's assumptions, not robots on a field.");
    if (simulated < std::ssize(report.sessions)) {
      lines.push_back(fmt::format("Only {} of {} sessions are simulated; they are pooled all the same.", simulated,
                                  report.sessions.size()));
    }
  }
  if (report.logs.size() > 1)
    lines.push_back(fmt::format("{} logs, each kick of which counts once", report.logs.size()));
  for (const Arm& arm : report.arms) lines.push_back(arm_line(arm));
  std::vector<const log::RecordedSession*> sessions;  // an experiment has thousands
  for (const log::RecordedSession& session : report.sessions)
    if (!session.arm) sessions.push_back(&session);
  const std::size_t shown = sessions.size() > kMostSessions ? kMostSessions / 2 : sessions.size();
  for (const auto* const session : std::span{sessions}.first(shown)) add_session(lines, *session, report.imports);
  if (shown < sessions.size())
    lines.push_back(fmt::format("and {} more sessions, in JSON each", sessions.size() - shown));
  for (const SessionNote& note : report.notes) lines.push_back(line_of(note));
  for (const PlayedLength& length : report.lengths)
    lines.push_back(fmt::format("Planned {:.0f} s, recorded {:.1f} s{}", length.planned_s, length.recorded_s,
                                length.cut_short() ? ": CUT SHORT" : ""));
  return lines;
}

std::string shell_word(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=+:,@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain) && word.front() != '-') return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string next_comparison(const Report& report) {
  const bool kicks = std::ranges::any_of(report.policies, [](const PolicyRow& row) { return row.kicks() > 0; });
  const bool replays = std::ranges::any_of(
      report.sessions, [](const log::RecordedSession& session) { return !session.replays_uuid.empty(); });
  if (!kicks || replays) return "";
  const bool apart = std::ranges::any_of(report.policies, &PolicyRow::blocked_apart);
  const std::string rest = logs_of(report) + (apart ? " --blocked apart" : "");
  if (report.arms.size() > 1) return fmt::format("How sure are the differences: trivela compare{} --by arm", rest);
  if (report.policies.size() > 1)
    return fmt::format("How sure is the difference: trivela compare{}{}", rest, counts_of(report));
  if (report.logs.size() > 1)
    return fmt::format("How sure is the difference between the logs: trivela compare{} --by log", rest);
  if (!report.robots.empty())
    return fmt::format("How sure is the difference between the robots: trivela compare{} --by robot", rest);
  return fmt::format("To compare it with another log: trivela compare{} OTHER.db", rest);
}

}  // namespace trivela::evaluator
