#include "nodes/kicker_drift/kicker_drift_node.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "kicking/geometry/time.hpp"
#include "kicking/optional_double.hpp"
#include "nodes/runtime/node_main.hpp"

namespace trivela::nodes {
namespace {

// An order that came twice is refused as `double` after it was fired: what was said before holds. A driver that was
// restarted counts from 1.
auto weight(const msg::KickReceipt& receipt) {
  return std::tuple(receipt.refusal != msg::REFUSAL_DOUBLE, receipt.t_ns, receipt.seq);
}

bus::ReaderOptions looking_on() {
  bus::ReaderOptions options;
  options.keep_all = true;  // in lockstep cycles come faster than the watch looks through its kicks
  options.observer = true;
  return options;
}

msg::KickerDrift drift_message(const evaluator::DriftEstimate& timeline,
                               std::span<const evaluator::WatchedKick> kicks) {
  msg::KickerDrift message{};
  message.factor = message.factor_se = message.height_m = message.table_factor = msg::kNone;
  if (timeline.drifts.empty()) return message;
  const evaluator::Drift& drift = timeline.drifts.back();
  const bool speed = drift.kind == evaluator::DriftKind::kExitSpeed;
  message.t_ns = kicks[drift.found].t_ns;
  message.changes = static_cast<std::uint32_t>(timeline.drifts.size());
  message.changed_kick_id = kicks[drift.changed].kick_id;
  message.found_kick_id = kicks[drift.found].kick_id;
  message.kind = speed ? msg::DRIFT_EXIT_SPEED : msg::DRIFT_ELEVATION;
  message.factor = std::exp(drift.factor.value);
  message.factor_se = drift.factor.se;
  message.height_m = drift.height_m;
  if (speed) message.table_factor = message.factor;
  return message;
}

bool says_the_same(const msg::KickerDrift& a, const msg::KickerDrift& b) {
  return std::tie(a.changes, a.changed_kick_id, a.found_kick_id, a.kind) ==
         std::tie(b.changes, b.changed_kick_id, b.found_kick_id, b.kind);
}

}  // namespace

KickSeries::Texts* KickSeries::words_of(std::int64_t kick_id) {
  if (kick_id <= 0) return nullptr;
  const auto known = texts_.find(kick_id);
  if (known != texts_.end()) return &known->second;
  return texts_.size() < kMostKicks ? &texts_[kick_id] : nullptr;
}

bool KickSeries::receive(const msg::KickDecision& decision) {
  Texts* const kick = decision.fire && decision.t_ns >= 0 ? words_of(decision.kick_id) : nullptr;
  if (kick == nullptr || (kick->decision && kick->decision->seq <= decision.seq)) return false;
  kick->decision = decision;
  return true;
}

bool KickSeries::receive(const msg::KickReceipt& receipt) {
  Texts* const kick = receipt.release_t_ns >= 0 ? words_of(receipt.kick_id) : nullptr;
  if (kick == nullptr || (kick->receipt && weight(receipt) <= weight(*kick->receipt))) return false;
  kick->receipt = receipt;
  return true;
}

bool KickSeries::receive(const msg::KickOutcome& outcome) {
  Texts* const kick = words_of(outcome.kick_id);
  if (kick == nullptr || (kick->outcome && outcome.seq <= kick->outcome->seq)) return false;
  kick->outcome = outcome;
  return true;
}

std::vector<evaluator::WatchedKick> KickSeries::kicks() const {
  std::vector<evaluator::WatchedKick> kicks;
  for (const auto& [kick_id, words] : texts_) {
    if (words.decision && words.receipt && words.receipt->accepted) kicks.push_back(watched(words));
  }
  std::ranges::sort(kicks, {}, [](const evaluator::WatchedKick& kick) { return std::pair(kick.t_ns, kick.kick_id); });
  return kicks;
}

evaluator::WatchedKick KickSeries::watched(const Texts& words) {
  const msg::KickDecision& decision = *words.decision;
  evaluator::WatchedKick kick{.kick_id = decision.kick_id,
                              .t_ns = decision.t_ns,
                              .robot = {decision.x_m, decision.y_m, decision.heading_rad},
                              .twist = {decision.vx_mps, decision.vy_mps, decision.omega_radps},
                              .lead_s = kicking::seconds(words.receipt->release_t_ns - decision.t_ns),
                              .policy = static_cast<int>(decision.policy),
                              .goal_y_m = decision.target_y_m};
  const kicking::OptionalDouble x_m = decision.predicted_x_cross_m, z_m = decision.predicted_z_cross_m,
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

KickerDriftNode::KickerDriftNode(NodeContext& context)
    : context_(context),
      node_(context.participant, "kicker_drift", context.robot_id()),
      drift_out_(node_.writer<msg::KickerDrift>()) {
  reject_duplicate_node(context_, drift_out_, "kicker_drift");
  listen<msg::KickDecision>();
  listen<msg::KickReceipt>();
  listen<msg::KickOutcome>();
}

template <class T>
void KickerDriftNode::listen() {
  node_.on<T>(
      [this](const T& word) {
        if (!context_.participant.believes(word.t_ns)) return;
        const std::lock_guard lock{mutex_};
        if (series_.receive(word)) judge();
      },
      bus::writes<msg::KickerDrift>(), looking_on());
}

void KickerDriftNode::judge() {
  const auto kicks = series_.kicks();
  std::vector<evaluator::KickResidual> residuals;
  residuals.reserve(kicks.size());
  for (const evaluator::WatchedKick& kick : kicks) residuals.push_back(evaluator::residual_of(kick));
  const evaluator::DriftEstimate timeline = evaluator::drifts_of(residuals);
  const msg::KickerDrift message = drift_message(timeline, kicks);
  if (says_the_same(message, said_)) return;
  say(message);
  if (timeline.drifts.empty()) {
    context_.logger->info("the kicker has not changed: a later outcome of its kicks takes that back");
  } else {
    context_.logger->warn("the kicker changed at kick {}: {}; {}", message.changed_kick_id,
                          evaluator::words_of(timeline.drifts.back()),
                          evaluator::correction_of(timeline.drifts.back()));
  }
}

void KickerDriftNode::say(const msg::KickerDrift& drift) {
  const std::uint64_t seq = said_.seq + 1;
  said_ = drift;
  said_.robot_id = context_.robot_id();
  said_.seq = seq;
  drift_out_.write(said_);
}

int kicker_drift_main(int argc, char** argv) {
  return node_main(argc, argv, "kicker_drift", [](NodeContext& context) {
    KickerDriftNode node{context};
    run(context, node.node());
  });
}

}  // namespace trivela::nodes
