#include "pages/monitor/running_table.hpp"

#include "evaluator/stats/confidence_sequence.hpp"

namespace trivela::pages {
namespace {

namespace stats = evaluator::stats;

RunningDifference difference_of(const RunningRow& older, const RunningRow& newer) {
  return {older.policy, newer.policy,
          stats::efficiency(newer.counts()).value_or(0.0) - stats::efficiency(older.counts()).value_or(0.0),
          stats::difference_sequence(older.counts(), newer.counts())};
}

}  // namespace

RunningTable running_table(const std::map<std::optional<PolicyLabel>, KickTally>& tallies) {
  RunningTable table;
  std::optional<RunningRow> nobodys;
  for (const auto& [policy, kicks] : tallies) {
    RunningRow row{policy ? policy->name() : "not received", kicks};
    row.interval = stats::confidence_sequence(row.counts());
    if (policy) {
      table.rows.push_back(row);
    } else {
      nobodys = row;
    }
  }
  std::vector<const RunningRow*> compared;
  for (const RunningRow& row : table.rows) {
    if (row.counts().n > 0) compared.push_back(&row);
  }
  if (compared.size() >= 2) table.difference = difference_of(*compared[0], *compared[1]);
  if (nobodys) table.rows.push_back(*nobodys);
  return table;
}

}  // namespace trivela::pages
