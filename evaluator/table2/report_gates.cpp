#include "evaluator/render/gate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "evaluator/table2/report_parts.hpp"
#include "evaluator/table2/table2.hpp"

namespace trivela::evaluator {
namespace {

using MetricValue = std::optional<double>;

MetricValue count_of(std::int64_t n) { return static_cast<double>(n); }

MetricValue if_kicks(const PolicyRow& row, double value) {
  return row.counts().n > 0 ? MetricValue(value) : std::nullopt;
}

struct RowMetric {
  std::string_view name;
  MetricValue (*of)(const PolicyRow&);
};

constexpr std::array kOfRow{
    RowMetric{"efficiency", [](const PolicyRow& row) { return stats::efficiency(row.counts()); }},
    RowMetric{"efficiency_lo", [](const PolicyRow& row) { return if_kicks(row, row.efficiency_ci().lo); }},
    RowMetric{"efficiency_hi", [](const PolicyRow& row) { return if_kicks(row, row.efficiency_ci().hi); }},
    RowMetric{"efficiency_worst", [](const PolicyRow& row) { return if_kicks(row, row.efficiency_bounds().lo); }},
    RowMetric{"kicks", [](const PolicyRow& row) { return count_of(row.kicks()); }},
    RowMetric{"inside", [](const PolicyRow& row) { return count_of(row.inside()); }},
    RowMetric{"outside", [](const PolicyRow& row) { return count_of(row.outside()); }},
    RowMetric{"unknown", [](const PolicyRow& row) { return count_of(row.unknown()); }},
    RowMetric{"unknown_share",
              [](const PolicyRow& row) {
                return stats::efficiency({row.unknown(), row.kicks()});
              }},
    RowMetric{"blocked", [](const PolicyRow& row) { return count_of(row.blocked()); }},
    RowMetric{"goals", [](const PolicyRow& row) { return count_of(row.goals()); }},
    RowMetric{"saved", [](const PolicyRow& row) { return count_of(row.saved()); }},
    RowMetric{"minutes", [](const PolicyRow& row) { return row.played_min; }},
    RowMetric{"kicks_per_min", [](const PolicyRow& row) { return row.kicks_per_min(); }},
    RowMetric{"on_target_per_min", [](const PolicyRow& row) { return row.per_min(row.inside()); }}};

struct WholeMetric {
  std::string_view name;
  MetricValue (*of)(const Report&);
};

constexpr std::array kOfWhole{
    WholeMetric{"missing_rows", [](const Report& report) { return count_of(report.rows_missing()); }},
    WholeMetric{"unclosed_sessions", [](const Report& report) { return count_of(report.unclosed_sessions()); }},
    WholeMetric{"unclosed_kicks", [](const Report& report) { return count_of(std::ssize(report.unclosed_kicks)); }},
    WholeMetric{"silences",
                [](const Report& report) {
                  return count_of(std::ranges::count_if(report.silences, &RecordedSilence::counts));
                }},
    WholeMetric{"refused_orders",
                [](const Report& report) {
                  std::int64_t sum = 0;
                  for (const RefusedOrders& refused : report.refused_orders) {
                    if (refused.refusal != "not_known") sum += refused.orders;
                  }
                  return count_of(sum);
                }},
    WholeMetric{"sessions", [](const Report& report) { return count_of(std::ssize(report.sessions)); }},
    WholeMetric{"truth_agreement", [](const Report& report) {
                  return stats::efficiency({report.alike_with_truth, report.compared_with_truth});
                }}};

// The rows of a robot; of the only one those of all.
std::vector<PolicyRow> rows_of(const Report& report, std::optional<int> robot_id) {
  if (!robot_id) return report.policies;
  std::vector<PolicyRow> rows;
  for (const RobotRow& row : report.robots)
    if (row.robot_id == *robot_id) rows.push_back(row);
  const bool only = report.robot_ids.size() == 1 && report.robot_ids.front() == *robot_id;
  return only ? report.policies : rows;
}

// Those of an arm; where none is called so, of a policy.
std::vector<PolicyRow> rows_named(const std::vector<PolicyRow>& rows, const std::string& subject) {
  std::vector<PolicyRow> arms, policies;
  for (const PolicyRow& row : rows) {
    if ((row.arm.empty() ? row.policy : row.arm) == subject || name_of(row) == subject) arms.push_back(row);
    if (row.policy == subject) policies.push_back(row);
  }
  return arms.empty() ? policies : arms;
}

PolicyRow sum_of_rows(const std::vector<PolicyRow>& rows) {
  PolicyRow all = rows.front();
  for (std::size_t i = 1; i < rows.size(); ++i) {
    all += rows[i];
    all.repeated += rows[i].repeated;
  }
  if (rows.size() > 1) all.paired_ci.reset();
  return all;
}

Measured of_rows(const Report& report, const Gate& gate) {
  std::vector<PolicyRow> rows = rows_of(report, gate.robot_id);
  if (rows.empty())
    return {"", std::nullopt, gate.robot_id ? fmt::format("no row of robot {}", *gate.robot_id) : "no row"};
  if (!gate.subject.empty()) {
    std::vector<std::string> names;
    names.reserve(rows.size());
    for (const PolicyRow& row : rows) names.push_back(name_of(row));
    rows = rows_named(rows, gate.subject);
    if (rows.empty())
      return {"", std::nullopt, fmt::format("there is no '{}' ({})", gate.subject, fmt::join(names, ", "))};
  }
  std::set<std::string> arms;
  for (const PolicyRow& row : rows) arms.insert(row.arm);
  if (arms.size() > 1)
    return {"", std::nullopt, fmt::format("{} arms met the same opportunities and are not added up", arms.size())};
  const auto metric = std::ranges::find(kOfRow, gate.metric, &RowMetric::name);
  return {"", metric->of(sum_of_rows(rows)), "there are no kicks, or no minutes, to make it of"};
}

}  // namespace

const GateMetrics& report_gate_metrics() {
  static const GateMetrics metrics = [] {
    GateMetrics all;
    all.robots = true;
    for (const RowMetric& metric : kOfRow) all.of_subject.emplace_back(metric.name);
    for (const WholeMetric& metric : kOfWhole) all.of_whole.emplace_back(metric.name);
    return all;
  }();
  return metrics;
}

std::vector<GateResult> judge_gates(const Report& report, std::span<const Gate> gates) {
  std::vector<GateResult> results;
  for (const Gate& gate : gates) {
    const auto whole = std::ranges::find(kOfWhole, gate.metric, &WholeMetric::name);
    results.push_back(judged(gate, {whole != kOfWhole.end() ? Measured{"", whole->of(report), "nothing to make it of"}
                                                            : of_rows(report, gate)}));
  }
  return results;
}

}  // namespace trivela::evaluator
