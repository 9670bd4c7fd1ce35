#include "nodes/kicker_drift/kick_series.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "kicking/geometry/time.hpp"
#include "kicking/maybe.hpp"

namespace trivela::nodes {
namespace {

// An order that came twice is refused as `double` after it was fired: what was said before holds. A driver that was
// restarted counts from 1.
auto weight(const msg::KickReceipt& receipt) {
  return std::tuple(receipt.refusal != msg::REFUSAL_DOUBLE, receipt.t_ns, receipt.seq);
}

}  // namespace

KickSeries::Words* KickSeries::words_of(std::int64_t kick_id) {
  if (kick_id <= 0) return nullptr;
  const auto known = words_.find(kick_id);
  if (known != words_.end()) return &known->second;
  return words_.size() < kMostKicks ? &words_[kick_id] : nullptr;
}

bool KickSeries::hear(const msg::KickDecision& decision) {
  Words* const kick = decision.fire && decision.t_ns >= 0 ? words_of(decision.kick_id) : nullptr;
  if (kick == nullptr || (kick->decision && kick->decision->seq <= decision.seq)) return false;
  kick->decision = decision;
  return true;
}

bool KickSeries::hear(const msg::KickReceipt& receipt) {
  Words* const kick = receipt.release_t_ns >= 0 ? words_of(receipt.kick_id) : nullptr;
  if (kick == nullptr || (kick->receipt && weight(receipt) <= weight(*kick->receipt))) return false;
  kick->receipt = receipt;
  return true;
}

bool KickSeries::hear(const msg::KickOutcome& outcome) {
  Words* const kick = words_of(outcome.kick_id);
  if (kick == nullptr || (kick->outcome && outcome.seq <= kick->outcome->seq)) return false;
  kick->outcome = outcome;
  return true;
}

std::vector<evaluator::WatchedKick> KickSeries::kicks() const {
  std::vector<evaluator::WatchedKick> kicks;
  for (const auto& [kick_id, words] : words_) {
    if (words.decision && words.receipt && words.receipt->accepted) kicks.push_back(watched(words));
  }
  std::ranges::sort(kicks, {}, [](const evaluator::WatchedKick& kick) { return std::pair(kick.t_ns, kick.kick_id); });
  return kicks;
}

evaluator::WatchedKick KickSeries::watched(const Words& words) {
  const msg::KickDecision& decision = *words.decision;
  evaluator::WatchedKick kick{.kick_id = decision.kick_id,
                              .t_ns = decision.t_ns,
                              .robot = {decision.x_m, decision.y_m, decision.heading_rad},
                              .twist = {decision.vx_mps, decision.vy_mps, decision.omega_radps},
                              .lead_s = kicking::seconds(words.receipt->release_t_ns - decision.t_ns),
                              .policy = static_cast<int>(decision.policy),
                              .goal_y_m = decision.target_y_m};
  const kicking::Maybe x_m = decision.predicted_x_cross_m, z_m = decision.predicted_z_cross_m,
                       t_flight_s = decision.predicted_t_flight_s;
  if (!words.outcome || !x_m || !z_m || !t_flight_s || decision.kick_kind != 0) return kick;
  kick.x_m = *x_m;
  kick.z_m = *z_m;
  kick.t_flight_s = *t_flight_s;
  const msg::Outcome outcome = words.outcome->outcome;
  kick.seen_to_the_line = outcome != msg::OUTCOME_BLOCKED && outcome != msg::OUTCOME_UNKNOWN;
  kick.bounced = words.outcome->bounced;
  kick.z_cross_m = words.outcome->z_cross_m;
  kick.exit_speed_mps = words.outcome->exit_speed_mps;
  return kick;
}

}  // namespace trivela::nodes
