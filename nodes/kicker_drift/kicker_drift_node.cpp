#include "nodes/kicker_drift/kicker_drift_node.hpp"

#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include "evaluator/drift/drift_watch.hpp"
#include "idl/none.hpp"
#include "nodes/runtime/node_main.hpp"

namespace trivela::nodes {
namespace {

bus::ReaderOptions looking_on() {
  bus::ReaderOptions options;
  options.keep_all = true;  // in lockstep cycles come faster than the watch looks through its kicks
  options.observer = true;
  return options;
}

msg::KickerDrift drift_message(const evaluator::DriftEstimate& story, std::span<const evaluator::WatchedKick> kicks) {
  msg::KickerDrift message{};
  message.factor = message.factor_se = message.height_m = message.table_factor = msg::kNone;
  if (story.drifts.empty()) return message;
  const evaluator::Drift& drift = story.drifts.back();
  const bool speed = drift.kind == evaluator::DriftKind::kExitSpeed;
  message.t_ns = kicks[drift.found].t_ns;
  message.changes = static_cast<std::uint32_t>(story.drifts.size());
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
        if (series_.hear(word)) judge();
      },
      bus::writes<msg::KickerDrift>(), looking_on());
}

void KickerDriftNode::judge() {
  const auto kicks = series_.kicks();
  std::vector<evaluator::KickResidual> residuals;
  residuals.reserve(kicks.size());
  for (const evaluator::WatchedKick& kick : kicks) residuals.push_back(evaluator::residual_of(kick));
  const evaluator::DriftEstimate story = evaluator::drifts_of(residuals);
  const msg::KickerDrift message = drift_message(story, kicks);
  if (says_the_same(message, said_)) return;
  say(message);
  if (story.drifts.empty()) {
    context_.logger->info("the kicker has not changed: a later outcome of its kicks takes that back");
  } else {
    context_.logger->warn("the kicker changed at kick {}: {}; {}", message.changed_kick_id,
                          evaluator::words_of(story.drifts.back()), evaluator::correction_of(story.drifts.back()));
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
