#include "evaluator/counting/truth_count.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "evaluator/metrics/assigned_possessions.sql.hpp"

namespace trivela::evaluator {

TruthCount::TruthCount(const log::Reader& reader) {
  using Start = std::pair<std::int64_t, std::int64_t>;  // of play in a possession, and its number
  std::map<std::tuple<std::int64_t, int, int>, std::vector<Start>> starts;
  reader.query(
      "SELECT session_id, robot_id, half, possession_id, start_t_ns FROM possession_truths ORDER BY start_t_ns",
      [&](std::int64_t session_id, int robot_id, int half, std::int64_t number, std::int64_t start_t_ns) {
        sessions_.insert(session_id);
        starts[{session_id, robot_id, half}].emplace_back(start_t_ns, number);
      });
  if (starts.empty()) return;
  reader.query(kAssignedPossessionsSql, [&](const log::NamedCells& row) {
    const auto session_id = row.get<std::int64_t>("session_id");
    const auto robot_id = row.get<int>("robot_id");
    const auto half = row.get<int>("half");
    const auto own = row.get<std::int64_t>("possession_id");
    const auto t_ns = row.find<std::int64_t>("t_ns");
    const auto of_robot = starts.find({session_id, robot_id, half});
    if (!t_ns || of_robot == starts.end()) return;
    const auto later = std::ranges::upper_bound(of_robot->second, *t_ns, {}, &Start::first);
    if (later == of_robot->second.begin()) return;
    const std::int64_t number = std::prev(later)->second;
    if (number != own) other_[{session_id, robot_id, half, own}] = number;
  });
}

std::int64_t TruthCount::number(std::int64_t session_id, int robot_id, int half, std::int64_t own) const {
  const auto other = other_.find({session_id, robot_id, half, own});
  return other == other_.end() ? own : other->second;
}

}  // namespace trivela::evaluator
