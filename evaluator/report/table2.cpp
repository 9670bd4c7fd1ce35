#include "evaluator/report/table2.hpp"

#include <algorithm>

#include "evaluator/metrics/bounces_by_policy.sql.hpp"
#include "evaluator/metrics/minutes_by_policy.sql.hpp"
#include "evaluator/metrics/outcomes_by_policy.sql.hpp"
#include "evaluator/metrics/refused_orders.sql.hpp"
#include "evaluator/metrics/truth_agreement.sql.hpp"
#include "evaluator/metrics/unclosed_kicks.sql.hpp"

namespace trivela::evaluator {
namespace {

using Cells = std::span<const log::Value>;

using log::integer;
const std::string& text(const log::Value& value) { return std::get<std::string>(value); }

std::vector<PolicyRow> policy_rows(const log::Reader& reader, bool blocked_apart) {
  std::map<std::string, PolicyRow, std::greater<>> rows;  // "stopped" before "moving": the older policy first
  reader.query(kMinutesByPolicySql, [&](Cells row) {
    const auto* const played_min = std::get_if<double>(&row[1]);
    rows[text(row[0])].played_min = played_min != nullptr ? std::optional(*played_min) : std::nullopt;
  });
  reader.query(kOutcomesByPolicySql,
               [&](Cells row) { rows[text(row[0])].kicks_by_outcome[text(row[1])] = integer(row[2]); });
  reader.query(kBouncesByPolicySql, [&](Cells row) {
    rows[text(row[0])].bounces = {integer(row[1]), integer(row[2]), integer(row[3]), integer(row[4])};
  });
  std::vector<PolicyRow> result;
  for (auto& [policy, row] : rows) {
    row.policy = policy;
    row.blocked_apart = blocked_apart;
    result.push_back(std::move(row));
  }
  return result;
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
         std::ranges::any_of(unrecorded_orders, &UnrecordedOrders::counts);
}

Report make_report(const log::Reader& reader, bool blocked_apart) {
  Report report{.sessions = reader.sessions(),
                .policies = policy_rows(reader, blocked_apart),
                .losses = reader.losses(),
                .unclosed_kicks = {},
                .refused_orders = {},
                .silences = silences_of(reader),
                .unrecorded_orders = unrecorded_orders_of(reader),
                .labels = label_quality_of(reader),
                .warnings = reader.warnings(),
                .doubt = reader.doubt(),
                .verified_rows = reader.verification().compared ? reader.verification().rows : 0};
  for (PolicyRow& row : report.policies) row.doubt = report.labels.doubts[row.policy];
  for (std::string& warning : report.labels.goal_warnings()) report.warnings.push_back(std::move(warning));
  for (const log::RecordedSession& session : report.sessions) {
    if (!session.scenario.starts_with("replay of ")) continue;
    report.warnings.push_back("session " + session.uuid + " is a " + session.scenario +
                              ": the outcomes are those of the recorded kicks, whatever was ordered here");
  }
  reader.query(kUnclosedKicksSql, [&](Cells row) {
    report.unclosed_kicks.push_back({.session_id = integer(row[0]),
                                     .robot_id = static_cast<int>(integer(row[1])),
                                     .kick_id = integer(row[2]),
                                     .t_ns = integer(row[3]),
                                     .policy = text(row[4]),
                                     .has_order = integer(row[5]) != 0,
                                     .has_receipt = integer(row[6]) != 0,
                                     .has_outcome = integer(row[7]) != 0});
  });
  reader.query(kRefusedOrdersSql, [&](Cells row) {
    report.refused_orders.push_back({text(row[0]), text(row[1]), integer(row[2])});
  });
  reader.query(kTruthAgreementSql, [&](Cells row) {
    report.compared_with_truth = integer(row[0]);
    report.alike_with_truth = integer(row[1]);
  });
  return report;
}

}  // namespace trivela::evaluator
