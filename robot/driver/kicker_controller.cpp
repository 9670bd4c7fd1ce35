#include "robot/driver/kicker_controller.hpp"

#include <algorithm>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

static_assert(bus::has_labels<msg::KickerFault>(hal::kKickerFaultNames));

std::vector<kicking::Range> power_ranges(const kicking::RobotModel& model) {
  std::vector<kicking::Range> ranges;
  for (std::size_t i = 0; i < model.kinds(); ++i)
    ranges.push_back({model.kind(i).table.front().power, model.kind(i).table.back().power});
  return ranges;
}

}  // namespace

KickerController::KickerController(const config::KickerDriver& settings, double cycle_s,
                                   const kicking::RobotModel& model, std::uint8_t robot_id, DecisionNode decision)
    : gate_(settings, power_ranges(model), cycle_s),
      voltage_(settings.voltage_rise_v, settings.voltage_rise_s),
      decision_(decision),
      cycle_ns_(kicking::nanoseconds(cycle_s)),
      robot_id_(robot_id) {
  for (std::size_t i = 0; i < model.kinds(); ++i) delays_ns_.push_back(kicking::nanoseconds(model.kind(i).delay_s));
  gate_.decision_node(decision_ == DecisionNode::kThere);
}

void KickerController::began(std::int64_t now_t_ns) { gate_.rest_from(now_t_ns + cycle_ns_); }

msg::KickerStatus KickerController::status(const hal::KickerSample& sample, RefereePermission says,
                                           std::int64_t now_t_ns) {
  over_voltage_ = over_voltage(sample) || (over_voltage_ && sample.armed);  // until somebody opens the switch
  const bool stuck = voltage_.stuck(sample, stand_.state == msg::STATE_CHARGING);
  const bool charger = sample.fault == hal::KickerFault::kNone && (stuck || over_voltage_);
  const hal::KickerFault fault = charger ? hal::KickerFault::kCharger : sample.fault;
  gate_.device(sample, fault);
  gate_.referee(says);
  advance(now_t_ns);
  msg::KickerStatus out{};
  out.robot_id = robot_id_;
  out.seq = ++statuses_;
  out.t_ns = sample.t_ns;
  out.charge = sample.charge;
  out.charge_modelled = sample.charge_modelled;
  out.voltage_v = sample.voltage_v.to_message();
  out.armed = gate_.armed();
  out.ready = stand_.state == msg::STATE_READY;
  out.fault = static_cast<msg::KickerFault>(fault);
  out.state = stand_.state;
  out.last_kick_id = gate_.last_kick_id();
  out.last_accepted = gate_.last_accepted();
  out.orders_handled = gate_.handled();
  out.orders_refused = gate_.refused();
  out.lever_kind = delays_ns_.size() > 1 ? sample.lever_kind : std::uint8_t{0};
  return out;
}

/// The facts by now as events, those that forbid first: what is so already changes nothing.
void KickerController::advance(std::int64_t now_t_ns) {
  const bool healthy = gate_.healthy(now_t_ns);
  happened(over_voltage_ ? KickerEvent::kOverVoltage : healthy ? KickerEvent::kHealthy : KickerEvent::kFault);
  if (decision_ == DecisionNode::kLost) happened(KickerEvent::kDecisionLost);
  const bool armed = gate_.armed() && decision_ == DecisionNode::kThere;
  happened(armed ? KickerEvent::kArmed : KickerEvent::kDisarmed);
  const bool over = !gate_.under_way(now_t_ns), rested = gate_.rested(now_t_ns);
  if (over) happened(KickerEvent::kShotOver);
  if (rested) happened(KickerEvent::kRested);
  // A stop or a fault soon after a shot leads past cooling: what is armed again has to rest all the same.
  happened(gate_.charged() && over && rested ? KickerEvent::kCharged : KickerEvent::kUncharged);
}

void KickerController::decision_node(DecisionNode known, std::int64_t now_t_ns) {
  decision_ = known;
  gate_.decision_node(known == DecisionNode::kThere);
  advance(now_t_ns);
}

hal::ChargeCommand KickerController::end() {
  happened(KickerEvent::kEnd);
  return stand_.word;
}

msg::KickReceipt KickerController::answer(const msg::KickOrder& order, std::int64_t now_t_ns, OrderBy by) {
  advance(now_t_ns);
  const msg::Refusal refusal = gate_.judge(order, now_t_ns, by);
  msg::KickReceipt receipt{};
  receipt.robot_id = robot_id_;
  receipt.seq = ++receipts_;
  receipt.t_ns = now_t_ns;
  receipt.kick_id = order.kick_id;
  receipt.accepted = refusal == msg::REFUSAL_NONE;
  receipt.refusal = refusal;
  receipt.order_t_ns = order.t_ns;
  receipt.kick_kind = order.kick_kind;
  if (!receipt.accepted) return receipt;
  happened(KickerEvent::kAccepted);
  receipt.power = order.power;
  receipt.fired_t_ns = std::max(now_t_ns, order.fire_t_ns);
  receipt.release_t_ns = receipt.fired_t_ns + delays_ns_[order.kick_kind];
  return receipt;
}

std::optional<msg::KickReceipt> KickerController::withdrawal(std::int64_t now_t_ns) {
  const auto withdrawn = gate_.withdraw(now_t_ns);
  if (!withdrawn) return std::nullopt;
  return refused_after_all(*withdrawn, now_t_ns);
}

std::optional<msg::KickReceipt> KickerController::result(const hal::ShotResult& result, std::int64_t now_t_ns) {
  using What = hal::ShotResult::What;
  if (result.what == What::kFired) {
    gate_.fired(result.kick_id, result.t_ns);
    return std::nullopt;
  }
  const msg::Refusal reason = result.what == What::kLate        ? msg::REFUSAL_STALE
                              : result.what == What::kCalledOff ? msg::REFUSAL_UNARMED
                                                                : msg::REFUSAL_FAULT;
  const auto dropped = gate_.drop(result.kick_id, reason);
  if (!dropped) return std::nullopt;
  return refused_after_all(*dropped, now_t_ns);
}

msg::KickReceipt KickerController::refused_after_all(const OrderGate::Withdrawal& withdrawn, std::int64_t now_t_ns) {
  happened(KickerEvent::kCalledOff);
  advance(now_t_ns);
  return refusal_of(withdrawn, now_t_ns);
}

msg::KickReceipt KickerController::not_fired(const msg::KickReceipt& accepted, std::int64_t now_t_ns) {
  return refusal_of({accepted.kick_id, accepted.order_t_ns, msg::REFUSAL_FAULT}, now_t_ns);
}

msg::KickReceipt KickerController::not_known(const msg::KickReceipt& accepted, std::int64_t now_t_ns) {
  msg::KickReceipt receipt = accepted;
  receipt.seq = ++receipts_;
  receipt.t_ns = now_t_ns;
  receipt.refusal = msg::REFUSAL_NOT_KNOWN;
  return receipt;
}

msg::KickReceipt KickerController::refusal_of(const OrderGate::Withdrawal& withdrawn, std::int64_t now_t_ns) {
  msg::KickReceipt receipt{};
  receipt.robot_id = robot_id_;
  receipt.seq = ++receipts_;
  receipt.t_ns = now_t_ns;
  receipt.kick_id = withdrawn.kick_id;
  receipt.refusal = withdrawn.reason;
  receipt.order_t_ns = withdrawn.order_t_ns;
  return receipt;
}

}  // namespace trivela::robot
