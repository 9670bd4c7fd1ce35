#include "evaluator/table2/table2.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "evaluator/counting/policy_order.hpp"
#include "evaluator/metrics/refused_orders.sql.hpp"
#include "evaluator/metrics/truth_agreement.sql.hpp"
#include "evaluator/metrics/unclosed_kicks.sql.hpp"
#include "evaluator/table2/report_parts.hpp"

namespace trivela::evaluator {
namespace {

// What sessions say of robots that they have not recorded is nobody's.
void forget_absent_robots(std::vector<log::RecordedSession>& sessions, const LoggedOpportunities& logged) {
  std::map<std::int64_t, std::set<int>> robots;  // by session
  for (const LoggedOpportunity& o : logged.rows) robots[logged.sessions[o.session].session_id].insert(o.robot_id);
  for (log::RecordedSession& session : sessions) {
    std::set<int> own;
    for (const log::HalfPolicy& half : session.policies) own.insert(half.robot_id);
    const std::set<int>& recorded = robots[session.session_id];
    const bool others = recorded.empty() || std::ranges::any_of(recorded, [&](int id) { return !own.contains(id); });
    std::erase_if(session.policies, [&](const log::HalfPolicy& half) {
      return half.robot_id == 0 ? !others : !recorded.contains(half.robot_id);
    });
  }
}

// What a log has of its own: an earlier one has not its sessions.
template <class Row>
void append(std::vector<Row>& all, std::vector<Row> rows, const std::set<std::int64_t>& own) {
  std::erase_if(rows, [&](const Row& row) { return !own.contains(row.session_id); });
  all.insert(all.end(), rows.begin(), rows.end());
}

struct SessionLoss : log::Loss {
  std::int64_t session_id = 0;
};

void add_losses(std::map<std::string, log::Loss>& losses, const log::Reader& reader,
                const std::set<std::int64_t>& own) {
  using L = SessionLoss;
  const auto found = reader.rows<L>(
      "SELECT session_id, stream, sum(received), sum(lost), sum(gaps), sum(overflow), sum(nan_refused), sum(rejected), "
      "sum(out_of_order) FROM losses GROUP BY session_id, stream",
      &L::session_id, &L::stream, &L::received, &L::lost, &L::gaps, &L::overflow, &L::nan_refused, &L::rejected,
      &L::out_of_order);
  for (const L& loss : found)
    if (own.contains(loss.session_id))
      losses.try_emplace(loss.stream, log::Loss{.stream = loss.stream}).first->second += loss;
}

std::vector<UnclosedKick> unclosed_kicks_of(const log::Reader& reader) {
  using U = UnclosedKick;
  return reader.rows<U>(kUnclosedKicksSql, &U::session_id, &U::robot_id, &U::kick_id, &U::t_ns, &U::policy,
                        &U::has_order, &U::has_receipt, &U::has_outcome);
}

void add_refused_orders(std::vector<RefusedOrders>& refused, const log::Reader& reader) {
  reader.query(kRefusedOrdersSql,
               [&](const std::string& policy, const std::string& refusal, std::int64_t orders, std::int64_t not_fired) {
                 const auto known = std::ranges::find_if(
                     refused, [&](const RefusedOrders& row) { return row.policy == policy && row.refusal == refusal; });
                 if (known == refused.end()) {
                   refused.push_back({policy, refusal, orders, not_fired});
                 } else {
                   known->orders += orders;
                   known->not_fired += not_fired;
                 }
               });
}

// Each session of an experiment begins with the robot's file, and is left out. `log`: its name, where there are
// several.
void add_kickers(Report& report, const log::Reader& reader, const std::set<std::int64_t>& own, const std::string& log) {
  std::set<std::int64_t> alone;
  for (const log::RecordedSession& session : reader.sessions())
    if (!session.arm && own.contains(session.session_id)) alone.insert(session.session_id);
  if (alone.empty()) return;
  std::vector<LearnedKicker> kickers = learned_kickers_of(reader);
  for (LearnedKicker& kicker : kickers) kicker.log = log;
  append(report.kickers, kickers, alone);
}

// Adds everything but tables and lengths. `named`: several logs, whose sentences name them.
void add_log(Report& report, std::map<std::string, log::Loss>& losses, const OpenLog& log,
             const std::set<std::int64_t>& own, bool named) {
  const log::Reader& reader = *log.reader;
  const auto sentence = [&](const std::string& text) { return named ? log.name + ": " + text : text; };
  append(report.sessions, reader.sessions(), own);
  append(report.unclosed_kicks, unclosed_kicks_of(reader), own);
  append(report.silences, silences_of(reader), own);
  append(report.unrecorded_orders, unrecorded_orders_of(reader), own);
  report.imports.merge(import_notes_of(reader));
  add_losses(losses, reader, own);
  add_refused_orders(report.refused_orders, reader);
  append(report.notes, session_notes(reader), own);
  add_kickers(report, reader, own, named ? log.name : "");
  report.hand_labels.add(hand_labels_of(reader, own));
  const LabelQuality labels = label_quality_of(reader);
  report.labels.add(labels);
  for (const std::string& warning : reader.warnings()) report.warnings.push_back(sentence(warning));
  reader.query("SELECT matches_done, matches FROM experiments WHERE matches_done < matches",
               [&](std::int64_t done, std::int64_t matches) {
                 report.warnings.push_back(sentence(
                     fmt::format("the experiment is not finished, {} of {} matches are there", done, matches)));
               });
  for (const std::string& warning : labels.goal_warnings()) report.goal_warnings.push_back(sentence(warning));
  for (const std::string& warning : labels.release_warnings()) report.warnings.push_back(sentence(warning));
  if (const auto doubt = reader.doubt())
    report.doubt = (report.doubt ? *report.doubt + "; " : std::string()) + sentence(*doubt);
  report.verified_rows += reader.verification().compared ? reader.verification().rows : 0;
  reader.query(kTruthAgreementSql, [&](std::int64_t compared, std::int64_t alike) {
    report.compared_with_truth += compared;
    report.alike_with_truth += alike;
  });
}

// What differs between sessions of no arm, which are added up all the same.
std::string mixture_of(const LoggedOpportunities& logged, const std::vector<log::RecordedSession>& recorded) {
  std::set<std::uint32_t> worlds, settings;
  std::set<std::string> versions;
  std::set<std::int64_t> counted;
  for (const ComparedSession& session : logged.sessions) {
    if (!session.arm.empty() || !session.counts) continue;
    counted.insert(session.session_id);
    settings.insert(session.setup.settings);
    if (session.simulated) worlds.insert(session.setup.world);
  }
  for (const log::RecordedSession& session : recorded)
    if (counted.contains(session.session_id)) versions.insert(session.software_version);
  std::vector<std::string> differs;
  if (settings.size() > 1) differs.push_back(fmt::format("{} settings", settings.size()));
  if (worlds.size() > 1) differs.push_back(fmt::format("{} simulated worlds", worlds.size()));
  if (versions.size() > 1) differs.push_back(fmt::format("{} versions", versions.size()));
  return differs.empty() ? "" : fmt::format("added up though played with {}", fmt::join(differs, ", "));
}

void warn_of_replays(Report& report) {
  for (const log::RecordedSession& session : report.sessions) {
    if (session.replays_uuid.empty()) continue;
    report.warnings.push_back("session " + session.uuid + " is a " + session.scenario +
                              ": its kicks were decided and never made, so that none has an outcome");
  }
}

/// What is said of all sessions alike stands once and is of none of them alone; the rest keeps its session.
std::vector<SessionNote> joined(const std::vector<SessionNote>& notes, std::size_t sessions) {
  std::map<std::pair<std::string, std::string>, std::size_t> said;
  for (const SessionNote& note : notes) ++said[{note.kind, *note.text}];
  std::vector<SessionNote> result;
  for (const SessionNote& note : notes) {
    std::size_t& times = said[{note.kind, *note.text}];
    if (times == 0) continue;
    result.push_back(note);
    if (times < sessions) continue;
    result.back().uuid.clear();
    times = 0;
  }
  return result;
}

}  // namespace

std::int64_t Report::rows_missing() const {
  std::int64_t sum = 0;
  for (const log::Loss& loss : losses) sum += loss.missing();
  return sum;
}

std::int64_t Report::unclosed_sessions() const {
  return std::ranges::count_if(sessions, [](const auto& session) { return !session.closed_t_ns; });
}

bool Report::keeper() const {
  return std::ranges::any_of(policies, [](const PolicyRow& row) { return row.inside_kicks.goals(); });
}

std::int64_t Report::simulated_sessions() const {
  return std::ranges::count_if(sessions, &log::RecordedSession::simulated);
}

bool Report::data_lost() const {
  return rows_missing() > 0 || unclosed_sessions() > 0 || std::ranges::any_of(silences, &RecordedSilence::counts) ||
         std::ranges::any_of(unrecorded_orders, &UnrecordedOrders::counts) ||
         std::ranges::any_of(lengths, &PlayedLength::cut_short);
}

Report make_report(std::span<const OpenLog> logs, bool blocked_apart) {
  const LoggedOpportunities logged = read_opportunities(logs, false);
  Report report;
  report.logs = logged.logs;
  report.not_counted = logged.not_counted;
  std::vector<std::set<std::int64_t>> own(logs.size());  // sessions
  for (const ComparedSession& session : logged.sessions) own[session.log].insert(session.session_id);
  std::map<std::string, log::Loss> losses;
  std::vector<const log::Reader*> readers;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    add_log(report, losses, logs[i], own[i], logs.size() > 1);
    readers.push_back(logs[i].reader);
  }
  for (auto& [stream, loss] : losses) report.losses.push_back(std::move(loss));
  report.notes = joined(notes_that_hold(report.notes), report.sessions.size());
  std::ranges::stable_sort(report.refused_orders, PolicyOrder{}, &RefusedOrders::policy);
  forget_absent_robots(report.sessions, logged);
  report.lengths = played_lengths(readers, logged.sessions);
  Arms arms = arms_of(logged, report.sessions);
  ReportRows rows = report_rows({logged, report.sessions, arms, report.labels.doubts}, blocked_apart);
  report.policies = std::move(rows.policies);
  report.robots = std::move(rows.robots);
  report.robot_ids = std::move(rows.robot_ids);
  report.not_counted.insert(report.not_counted.end(), arms.apart.begin(), arms.apart.end());
  if (const std::string mix = mixture_of(logged, report.sessions); !mix.empty()) report.not_counted.push_back(mix);
  report.arms = std::move(arms.all);
  report.warnings.insert(report.warnings.end(), report.goal_warnings.begin(), report.goal_warnings.end());
  warn_of_replays(report);
  return report;
}

}  // namespace trivela::evaluator
