#include "evaluator/report/truth_count.hpp"

#include <algorithm>

namespace trivela::evaluator {
namespace {

constexpr int kOwnCountSince = 6;  // version of the log

}  // namespace

TruthCount::TruthCount(const log::Reader& reader) : one_count_(reader.version() < kOwnCountSince) {
  reader.query("SELECT session_id, robot_id, half, possession_id, t_ns FROM possession_truths ORDER BY t_ns",
               [this](std::int64_t session_id, int robot_id, int half, std::int64_t number, std::int64_t t_ns) {
                 sessions_.insert(session_id);
                 ends_[{session_id, robot_id, half}].emplace_back(t_ns, number);
               });
}

std::int64_t TruthCount::number(const OwnPossession& own) const {
  const auto ends = ends_.find({own.session_id, own.robot_id, own.half});
  if (one_count_ || !own.t_ns || ends == ends_.end()) return own.number;
  const auto end = std::ranges::upper_bound(ends->second, *own.t_ns, {}, &End::first);
  return end == ends->second.end() ? own.number : end->second;
}

}  // namespace trivela::evaluator
