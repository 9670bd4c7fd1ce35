#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "evaluator/report/own_half.hpp"
#include "evaluator/report/table2.hpp"
#include "evaluator/report/text_table.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::evaluator {
namespace {

using kicking::printable;
using Table = std::vector<std::vector<std::string>>;

std::string number(std::int64_t n) { return std::to_string(n); }

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
    if (one && !alone) text += fmt::format(" {}", printable(first));
    for (const log::HalfPolicy* const half : halves) {
      if (!one || alone) text += fmt::format("{} half {} {}", alone ? "," : "", half->half, printable(half->policy));
    }
  }
  return text;
}

std::string heading(const Report& report) {
  const auto simulated = report.simulated_sessions();
  std::string text;
  if (simulated > 0) {
    text += "SIMULATED MATCH: the numbers describe the simulation's assumptions, not robots on a field.\n";
    if (simulated < std::ssize(report.sessions)) {
      text += fmt::format("Only {} of {} sessions are simulated; they are pooled all the same.\n", simulated,
                          report.sessions.size());
    }
  }
  constexpr std::size_t kMostSessions = 8;  // an experiment has thousands
  const std::size_t shown = report.sessions.size() > kMostSessions ? kMostSessions / 2 : report.sessions.size();
  for (const auto& session : std::span{report.sessions}.first(shown)) {
    text += fmt::format("Session {}: {} '{}'", printable(session.uuid), session.simulated ? "scenario" : "match",
                        printable(session.scenario));
    if (session.seed) text += fmt::format(", seed {}", *session.seed);
    if (session.robot_id) text += fmt::format(", robot {}", *session.robot_id);
    text += who_played(session.policies);
    text +=
        fmt::format(", version {}, configuration {:.12}\n", printable(session.software_version), session.config_sha256);
    if (session.paired_halves && halves_of(session) > 1)
      text += "  its halves are paired: each has the possessions of the first\n";
    if (const auto notes = report.imports.find(session.session_id); notes != report.imports.end()) {
      for (const std::string& note : notes->second) text += fmt::format("  {}\n", printable(note));
    }
    if (!session.continues_uuid.empty())
      text += fmt::format("  it continues session {}\n", printable(session.continues_uuid));
  }
  if (shown < report.sessions.size())
    text += fmt::format("and {} more sessions, in JSON each\n", report.sessions.size() - shown);
  for (const SessionNote& note : report.notes) text += printable(line_of(note)) + "\n";
  for (const PlayedLength& length : report.lengths)
    text += fmt::format("Planned {:.0f} s, recorded {:.1f} s{}\n", length.planned_s, length.recorded_s,
                        length.cut_short() ? ": CUT SHORT" : "");
  return text;
}

std::string table2(const Report& report) {
  Table table = {{"policy", "inside", "outside", "unknown", "efficiency", "Wilson 95 %", "minutes", "kicks a minute"}};
  std::vector<NamedBounces> bounces;
  bool blocked_apart = false;
  for (const PolicyRow& row : report.policies) {
    bounces.push_back({printable(row.policy), row.bounces});
    blocked_apart = blocked_apart || row.blocked_apart;
    const auto efficiency = stats::efficiency(row.counts());
    const auto rate = row.kicks_per_min();
    table.push_back({row.policy, number(row.inside()), number(row.outside()), number(row.unknown()),
                     efficiency ? percent(*efficiency) : "-", efficiency ? percent(row.efficiency_ci()) : "-",
                     row.played_min ? fmt::format("{:.2f}", *row.played_min) : "-",
                     rate ? fmt::format("{:.2f}", *rate) : "-"});
  }
  std::string text = "\nTable 2: kicks by policy\n" + text_table(table) +
                     "  inside: between the posts and below the bar, saves included; it is not goals scored\n" +
                     bounce_lines(bounces);
  if (blocked_apart) text += "  blocked kicks stand apart, below: neither outside nor in the efficiency\n";
  for (const PolicyRow& row : report.policies) {
    if (row.repeated == 0) continue;
    text += fmt::format("  {} of the kicks of {} are in situations that it had in an earlier half, too{}\n",
                        row.repeated, printable(row.policy),
                        row.paired_ci ? ": its interval takes each situation once"
                                      : "; for an interval that allows for it these are too few situations");
  }
  return text;
}

std::string by_robot(const Report& report) {
  if (report.robots.empty()) return "";
  Table table = {
      {"robot", "policy", "inside", "outside", "unknown", "efficiency", "Wilson 95 %", "minutes", "kicks a minute"}};
  for (const RobotRow& row : report.robots) {
    const auto efficiency = stats::efficiency(row.counts());
    const auto rate = row.kicks_per_min();
    table.push_back({number(row.robot_id), row.policy.empty() ? "-" : row.policy, number(row.inside()),
                     number(row.outside()), number(row.unknown()), efficiency ? percent(*efficiency) : "-",
                     efficiency ? percent(stats::wilson(row.counts())) : "-",
                     row.played_min ? fmt::format("{:.2f}", *row.played_min) : "-",
                     rate ? fmt::format("{:.2f}", *rate) : "-"});
  }
  return "\nBy robot\n" + text_table(table) +
         "  minutes: of play, in the possessions in which the robot had the ball\n";
}

std::string misses(const Report& report) {
  Table table = {{"policy"}};
  for (const std::string& miss : kMisses) table[0].push_back(words(miss));
  const bool unsaid = std::ranges::any_of(report.policies, [](const PolicyRow& row) { return row.of("outside") > 0; });
  if (unsaid) table[0].push_back("not said");
  const bool own_half = std::ranges::any_of(report.policies, [](const PolicyRow& row) { return row.of(kOwnHalf) > 0; });
  if (own_half) table[0].push_back(words(kOwnHalf));
  table[0].push_back("unknown");
  for (const PolicyRow& row : report.policies) {
    table.push_back({row.policy});
    for (const std::string& miss : kMisses) table.back().push_back(number(row.of(miss)));
    if (unsaid) table.back().push_back(number(row.of("outside")));
    if (own_half) table.back().push_back(number(row.of(kOwnHalf)));
    table.back().push_back(number(row.unknown()));
  }
  return "\nWhy the misses missed\n" + text_table(table);
}

std::string label_quality(const LabelQuality& labels) {
  Table table = {{"sightings", "kicks", "unknown", "labels expected wrong"}};
  for (const SightingsRow& row : labels.rows) {
    if (row.kicks == 0) continue;
    table.push_back({row.sightings, number(row.kicks), number(row.unknown),
                     labels.has_probabilities ? fmt::format("{:.2f}", row.expected_wrong) : "-"});
  }
  return "\nOutcomes by sightings of the flight\n" + text_table(table) +
         (labels.has_probabilities ? "" : "  an older log: its labels came without their probabilities\n");
}

// Nobody counts the sightings of somebody who watched a video.
bool imported_alone(const Report& report) { return report.imports.size() == report.sessions.size(); }

std::string lost_rows(const Report& report) {
  if (report.rows_missing() == 0) return "  lost: nothing\n";
  Table table = {{"lost", "received", "lost on the bus", "gaps", "queue full", "not a number", "rejected", "late"}};
  for (const log::Loss& loss : report.losses) {
    if (loss.missing() == 0) continue;
    table.push_back({loss.stream, number(loss.received), number(loss.lost), number(loss.gaps), number(loss.overflow),
                     number(loss.nan_refused), number(loss.rejected), number(loss.out_of_order)});
  }
  return text_table(table);
}

std::string quality(const Report& report) {
  std::string text = "\nData quality\n" + lost_rows(report);
  for (const std::string& warning : report.warnings) text += fmt::format("  warning: {}\n", printable(warning));
  for (const std::string& line : report.not_counted) text += fmt::format("  {}\n", printable(line));
  for (const std::string& line : cut_short_lines(report.lengths)) text += fmt::format("  {}\n", line);
  for (const std::string& line : silence_lines(report.silences)) text += fmt::format("  {}\n", printable(line));
  for (const std::string& line : order_lines(report.unrecorded_orders)) text += fmt::format("  {}\n", line);
  text += report.doubt ? fmt::format("  {}\n", *report.doubt)
                       : fmt::format("  verified: {} rows are as they were recorded\n", report.verified_rows);
  for (const RefusedOrders& refused : report.refused_orders) {
    text += fmt::format("  refused orders, no kicks: {} x {} ({})\n", refused.orders, printable(words(refused.refusal)),
                        printable(refused.policy));
  }
  if (report.unclosed_kicks.empty()) text += "  unclosed kicks: none\n";
  for (const UnclosedKick& kick : report.unclosed_kicks) {
    text += fmt::format("  unclosed kick {} of robot {} at {:.2f} s ({}): no{}{}{}\n", kick.kick_id, kick.robot_id,
                        kicking::seconds(kick.t_ns), printable(kick.policy), kick.has_order ? "" : " order",
                        kick.has_receipt ? "" : " receipt", kick.has_outcome ? "" : " outcome");
  }
  for (const PolicyRow& row : report.policies) {
    if (row.unknown() == 0 && row.doubt.sum() <= 0.0) continue;
    const auto bounds = row.efficiency_bounds();
    text += fmt::format("  efficiency of {}: {} to {}", printable(row.policy), percent(bounds.lo), percent(bounds.hi));
    if (row.unknown() > 0) text += ", whatever the unknown kicks were";
    if (row.doubt.sum() > 0.0) {
      text += fmt::format("; mislabelled at most: {} inside, {} outside", stats::most_wrong(row.doubt.inside),
                          stats::most_wrong(row.doubt.outside));
    }
    text += "\n";
  }
  if (report.hand_labels.kicks > 0) text += fmt::format("  {}\n", report.hand_labels.line());
  if (report.compared_with_truth > 0) {
    text += fmt::format("  observed outcomes like the simulator's truth: {} of {}\n", report.alike_with_truth,
                        report.compared_with_truth);
  }
  return text;
}

std::string hint(const Report& report) {
  const bool replays = std::ranges::any_of(
      report.sessions, [](const log::RecordedSession& session) { return !session.replays_uuid.empty(); });
  if (report.policies.size() != 2 || replays) return "";
  std::string text =
      "\nHow sure is the difference: trivela compare LOG; by these counts alone: trivela compare --counts";
  for (const PolicyRow& row : report.policies) {
    if (row.counts().n == 0) return "";
    text += fmt::format(" {}={}/{}", printable(row.policy), row.counts().inside, row.counts().n);
  }
  return text + "\n";
}

}  // namespace

std::string to_text(const Report& report) {
  std::int64_t kicks = 0;
  for (const PolicyRow& row : report.policies) kicks += row.kicks();
  const std::string tables = kicks > 0 ? table2(report) + by_robot(report) + misses(report) +
                                             (imported_alone(report) ? "" : label_quality(report.labels))
                                       : table2(report) + "  there are no kicks\n";
  return heading(report) + tables + quality(report) + hint(report);
}

}  // namespace trivela::evaluator
