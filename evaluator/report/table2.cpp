#include "evaluator/report/table2.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <tuple>

#include "evaluator/metrics/bounces_by_policy.sql.hpp"
#include "evaluator/metrics/outcomes_by_policy.sql.hpp"
#include "evaluator/metrics/outcomes_by_robot.sql.hpp"
#include "evaluator/metrics/refused_orders.sql.hpp"
#include "evaluator/metrics/truth_agreement.sql.hpp"
#include "evaluator/metrics/unclosed_kicks.sql.hpp"
#include "evaluator/report/log_opportunities.hpp"
#include "evaluator/report/pair_counts.hpp"
#include "evaluator/stats/clustered.hpp"

namespace trivela::evaluator {
namespace {

using Rows = std::map<std::string, PolicyRow, std::greater<>>;  // by reverse alphabet: "stopped" before "moving"

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

// Arms of an experiment meet the same opportunities: under one policy's name they would count several times.
void refuse_arms_of_one_policy(const std::vector<log::RecordedSession>& sessions) {
  std::map<std::string, std::set<std::string>> arms;  // by policy
  for (const log::RecordedSession& session : sessions) {
    for (const log::HalfPolicy& half : session.policies) {
      if (session.arm) arms[half.policy].insert(*session.arm);
    }
  }
  for (const auto& [policy, names] : arms) {
    if (names.size() < 2) continue;
    throw std::runtime_error(fmt::format(
        "'{}' is the policy of several arms ({}), which meet the same opportunities: a table by policy would "
        "count them more than once; trivela compare --by arm has a row for each",
        policy, fmt::join(names, ", ")));
  }
}

void add_minutes(std::optional<double>& sum, double minutes) { sum = sum.value_or(0.0) + minutes; }

// Situations of paired halves are one thing each, however many halves had them.
void allow_for_paired_halves(const LoggedOpportunities& logged, Rows& rows) {
  using Situation = std::tuple<std::uint32_t, std::uint32_t, int, int, std::int64_t>;  // match, play, robot, half, id
  std::map<std::string, std::map<Situation, stats::Counts>> situations;
  for (const LoggedOpportunity& o : logged.rows) {
    if (o.ending != Ending::kInside && o.ending != Ending::kOutside) continue;
    const ComparedSession& session = logged.sessions[o.session];
    const int half = session.paired_halves && o.possession_id != 0 ? 0 : o.half;
    stats::Counts& counts = situations[o.policy][{session.match, session.play, o.robot_id, half, o.possession_id}];
    if (half == 0 && counts.n > 0) ++rows[o.policy].repeated;
    add(counts, o.ending);
  }
  for (auto& [policy, row] : rows) {
    if (row.repeated == 0) continue;
    std::vector<stats::Counts> counts;
    for (const auto& [situation, of] : situations[policy]) counts.push_back(of);
    row.paired_ci = stats::clustered_wilson(counts);
  }
}

std::vector<PolicyRow> policy_rows(const log::Reader& reader, const std::vector<log::RecordedSession>& sessions,
                                   const LoggedOpportunities& logged, bool blocked_apart) {
  Rows rows;
  for (const log::RecordedSession& session : sessions) {
    for (const log::HalfPolicy& half : session.policies) rows[half.policy];  // whether it kicked or not
  }
  for (const PlayedSpan& span : logged.spans) {
    std::set<std::string> policies;
    for (const PolicyOfRobot& who : span.had_it) policies.insert(who.policy);
    policies.erase("");
    for (const std::string& policy : policies) add_minutes(rows[policy].played_min, span.minutes);
  }
  reader.query(kOutcomesByPolicySql, [&](const std::string& policy, const std::string& outcome, std::int64_t kicks) {
    rows[policy].kicks_by_outcome[outcome] = kicks;
  });
  reader.query(kBouncesByPolicySql, [&](const std::string& policy, std::int64_t observed, std::int64_t observed_bounced,
                                        std::int64_t truth, std::int64_t truth_bounced) {
    rows[policy].bounces = {observed, observed_bounced, truth, truth_bounced};
  });
  allow_for_paired_halves(logged, rows);
  std::vector<PolicyRow> result;
  for (auto& [policy, row] : rows) {
    row.policy = policy;
    row.blocked_apart = blocked_apart;
    result.push_back(std::move(row));
  }
  return result;
}

std::vector<RobotRow> robot_rows(const log::Reader& reader, const LoggedOpportunities& logged, bool blocked_apart) {
  std::map<std::pair<int, std::string>, RobotRow> rows;
  std::set<int> robots;
  for (const PlayedSpan& span : logged.spans) {
    for (const PolicyOfRobot& who : span.had_it) {
      if (who.robot_id != 0) add_minutes(rows[{who.robot_id, who.policy}].played_min, span.minutes);
    }
  }
  reader.query(kOutcomesByRobotSql,
               [&](int robot_id, const std::string& policy, const std::string& outcome, std::int64_t kicks) {
                 rows[{robot_id, policy}].kicks_by_outcome[outcome] = kicks;
               });
  for (auto& [key, row] : rows) {
    std::tie(row.robot_id, row.policy) = key;
    row.blocked_apart = blocked_apart;
    robots.insert(row.robot_id);
  }
  std::vector<RobotRow> result;
  for (auto& [key, row] : rows) {
    if (robots.size() > 1) result.push_back(std::move(row));
  }
  return result;
}

std::vector<UnclosedKick> unclosed_kicks_of(const log::Reader& reader) {
  using U = UnclosedKick;
  return reader.rows<U>(kUnclosedKicksSql, &U::session_id, &U::robot_id, &U::kick_id, &U::t_ns, &U::policy,
                        &U::has_order, &U::has_receipt, &U::has_outcome);
}

std::vector<RefusedOrders> refused_orders_of(const log::Reader& reader) {
  using R = RefusedOrders;
  return reader.rows<R>(kRefusedOrdersSql, &R::policy, &R::refusal, &R::orders);
}

}  // namespace

std::int64_t PolicyRow::kicks() const {
  std::int64_t sum = 0;
  for (const auto& [outcome, n] : kicks_by_outcome) sum += n;
  return sum;
}

std::int64_t PolicyRow::of(const std::string& outcome) const {
  const auto found = kicks_by_outcome.find(outcome);
  return found == kicks_by_outcome.end() ? 0 : found->second;
}

stats::Interval PolicyRow::efficiency_bounds() const { return stats::efficiency_bounds({counts(), unknown(), doubt}); }

std::optional<double> PolicyRow::kicks_per_min() const {
  if (!played_min || *played_min <= 0.0) return std::nullopt;
  return static_cast<double>(kicks()) / *played_min;
}

std::int64_t Report::rows_missing() const {
  std::int64_t sum = 0;
  for (const log::Loss& loss : losses) sum += loss.missing();
  return sum;
}

std::int64_t Report::unclosed_sessions() const {
  return std::ranges::count_if(sessions, [](const auto& session) { return !session.closed_t_ns; });
}

std::int64_t Report::simulated_sessions() const {
  return std::ranges::count_if(sessions, &log::RecordedSession::simulated);
}

bool Report::data_lost() const {
  return rows_missing() > 0 || unclosed_sessions() > 0 || std::ranges::any_of(silences, &RecordedSilence::counts) ||
         std::ranges::any_of(unrecorded_orders, &UnrecordedOrders::counts) ||
         std::ranges::any_of(lengths, &PlayedLength::cut_short);
}

Report make_report(const log::Reader& reader, bool blocked_apart) {
  const LoggedOpportunities logged = read_opportunities(reader, "this log", false);
  std::vector<log::RecordedSession> sessions = reader.sessions();
  refuse_arms_of_one_policy(sessions);
  forget_absent_robots(sessions, logged);
  Report report{.sessions = sessions,
                .notes = notes_that_hold(session_notes(reader)),
                .policies = policy_rows(reader, sessions, logged, blocked_apart),
                .robots = robot_rows(reader, logged, blocked_apart),
                .lengths = played_lengths(reader, logged.sessions),
                .imports = import_notes_of(reader),
                .not_counted = logged.not_counted,
                .losses = reader.losses(),
                .unclosed_kicks = unclosed_kicks_of(reader),
                .refused_orders = refused_orders_of(reader),
                .silences = silences_of(reader),
                .unrecorded_orders = unrecorded_orders_of(reader),
                .labels = label_quality_of(reader),
                .hand_labels = hand_labels_of(reader),
                .warnings = reader.warnings(),
                .doubt = reader.doubt(),
                .verified_rows = reader.verification().compared ? reader.verification().rows : 0};
  for (PolicyRow& row : report.policies) row.doubt = report.labels.doubts[row.policy];
  for (std::string& warning : report.labels.goal_warnings()) report.warnings.push_back(std::move(warning));
  for (const log::RecordedSession& session : report.sessions) {
    if (session.replays_uuid.empty()) continue;
    report.warnings.push_back("session " + session.uuid + " is a " + session.scenario +
                              ": the outcomes are those of the recorded kicks, whatever was ordered here");
  }
  reader.query(kTruthAgreementSql, [&](std::int64_t compared, std::int64_t alike) {
    report.compared_with_truth = compared;
    report.alike_with_truth = alike;
  });
  return report;
}

}  // namespace trivela::evaluator
