#include "robot/driver/order_gate.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::robot {
namespace {

constexpr double kClockStep_s = 1e-9;

/// In floating point, for the difference of any two times on the wire.
double seconds_from(std::int64_t from_t_ns, std::int64_t to_t_ns) {
  return (static_cast<double>(to_t_ns) - static_cast<double>(from_t_ns)) * 1e-9;
}

/// The same wish, whenever it was sent.
bool same(const msg::KickOrder& a, const msg::KickOrder& b) {
  const bool same_power = a.power == b.power || (std::isnan(a.power) && std::isnan(b.power));
  return a.kick_id == b.kick_id && a.t_ns == b.t_ns && same_power && a.fire_t_ns == b.fire_t_ns &&
         a.valid_until_t_ns == b.valid_until_t_ns && a.possession == b.possession && a.kick_kind == b.kick_kind;
}

}  // namespace

bool OrderGate::healthy(std::int64_t now_t_ns) const {
  if (!sample_ || sample_->fault != hal::KickerFault::kNone) return false;
  const double age_s = seconds_from(sample_->t_ns, now_t_ns);
  return age_s <= settings_.link_timeout_s && age_s >= -settings_.future_tolerance_s;
}

bool OrderGate::rested(std::int64_t now_t_ns) const {
  return !last_fire_t_ns_ || seconds_from(*last_fire_t_ns_, now_t_ns) >= settings_.min_interval_s;
}

bool OrderGate::under_way(std::int64_t now_t_ns) const {
  constexpr double kLongestPulse_s = 0.05;
  return accepted_ && seconds_from(accepted_->fire_t_ns, now_t_ns) < kLongestPulse_s;
}

bool OrderGate::known(const msg::KickOrder& order) const {
  return std::ranges::find(accepted_ids_, order.kick_id) != accepted_ids_.end() ||
         std::ranges::any_of(refused_orders_, [&](const msg::KickOrder& refused) { return same(refused, order); });
}

void OrderGate::remember(const msg::KickOrder& order, bool accepted) {
  if (accepted) {
    accepted_ids_[oldest_accepted_] = order.kick_id;
    oldest_accepted_ = (oldest_accepted_ + 1) % kRemembered;
  } else if (!known(order)) {
    refused_orders_[oldest_refused_] = order;
    oldest_refused_ = (oldest_refused_ + 1) % kRemembered;
  }
}

bool OrderGate::ready(std::int64_t now_t_ns) const {
  return healthy(now_t_ns) && armed() && decision_there_ && !under_way(now_t_ns) && rested(now_t_ns) && charged();
}

msg::Refusal OrderGate::disarmed() const {
  const bool switched_on = sample_ && sample_->armed;
  return switched_on && referee_ == RefereePermission::kSilent ? msg::REFUSAL_REFEREE_SILENT : msg::REFUSAL_UNARMED;
}

msg::Refusal OrderGate::reason(const msg::KickOrder& order, std::int64_t now_t_ns, OrderBy by) const {
  if (by == OrderBy::kUnauthorised) return msg::REFUSAL_UNAUTHORISED;
  if (sample_ && !healthy(now_t_ns)) return msg::REFUSAL_FAULT;
  const bool kind_known = order.kick_kind < powers_.size();
  if (!kind_known || !powers_[order.kick_kind].contains(order.power) || order.kick_id <= 0)
    return msg::REFUSAL_OUT_OF_RANGE;
  if (!order.possession) return msg::REFUSAL_NO_BALL;
  if (!armed() || !decision_there_) return disarmed();
  if (seconds_from(order.t_ns, now_t_ns) > settings_.max_order_age_s) return msg::REFUSAL_STALE;
  const double ahead_s = seconds_from(now_t_ns, std::max(order.t_ns, order.fire_t_ns));
  if (now_t_ns > order.valid_until_t_ns || ahead_s > settings_.future_tolerance_s) return msg::REFUSAL_STALE;
  const double after_s = seconds_from(order.t_ns, order.fire_t_ns);
  if (!(after_s >= 0.0 && after_s <= cycle_s_ + kClockStep_s)) return msg::REFUSAL_STALE;
  if (known(order) || under_way(now_t_ns) || !rested(now_t_ns)) return msg::REFUSAL_DOUBLE;
  if (!charged()) return msg::REFUSAL_CHARGING;
  if (powers_.size() > 1 && sample_->lever_kind != order.kick_kind) return msg::REFUSAL_LEVER;
  return msg::REFUSAL_NONE;
}

msg::Refusal OrderGate::judge(const msg::KickOrder& order, std::int64_t now_t_ns, OrderBy by) {
  const msg::Refusal refusal = reason(order, now_t_ns, by);
  ++handled_;
  if (by == OrderBy::kUnauthorised) {
    ++refused_;
    return refusal;
  }
  remember(order, refusal == msg::REFUSAL_NONE);
  last_kick_id_ = order.kick_id;
  last_accepted_ = refusal == msg::REFUSAL_NONE;
  if (last_accepted_) {
    const std::int64_t fire_t_ns = std::max(now_t_ns, order.fire_t_ns);
    accepted_ = Accepted{order.kick_id, order.t_ns, fire_t_ns, last_fire_t_ns_};
    last_fire_t_ns_ = fire_t_ns;
  } else {
    ++refused_;
  }
  return refusal;
}

std::optional<OrderGate::Withdrawal> OrderGate::withdraw(std::int64_t now_t_ns) {
  if (!accepted_ || accepted_->fire_t_ns <= now_t_ns || (healthy(now_t_ns) && armed())) return std::nullopt;
  return drop(accepted_->kick_id, healthy(now_t_ns) ? disarmed() : msg::REFUSAL_FAULT);
}

std::optional<OrderGate::Withdrawal> OrderGate::drop(std::int64_t kick_id, msg::Refusal reason) {
  if (!accepted_ || accepted_->kick_id != kick_id) return std::nullopt;
  const Withdrawal withdrawal{kick_id, accepted_->order_t_ns, reason};
  last_fire_t_ns_ = accepted_->fire_before_t_ns;
  if (last_kick_id_ == kick_id) last_accepted_ = false;
  ++refused_;
  accepted_.reset();
  return withdrawal;
}

void OrderGate::fired(std::int64_t kick_id, std::int64_t t_ns) {
  if (!accepted_ || accepted_->kick_id != kick_id) return;
  accepted_->fire_t_ns = std::max(accepted_->fire_t_ns, t_ns);
  last_fire_t_ns_ = accepted_->fire_t_ns;
}

}  // namespace trivela::robot
