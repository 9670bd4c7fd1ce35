#include "nodes/kicker_driver/order_gate.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::nodes {
namespace {

constexpr double kClockStep_s = 1e-9;

/// In floating point, for the difference of any two times on the wire.
double seconds_from(std::int64_t from_t_ns, std::int64_t to_t_ns) {
  return (static_cast<double>(to_t_ns) - static_cast<double>(from_t_ns)) * 1e-9;
}

}  // namespace

bool OrderGate::sound(std::int64_t now_t_ns) const {
  return sample_ && sample_->fault == hal::KickerFault::kNone &&
         seconds_from(sample_->t_ns, now_t_ns) <= settings_.link_timeout_s;
}

bool OrderGate::rested(std::int64_t now_t_ns) const {
  return !last_fire_t_ns_ || seconds_from(*last_fire_t_ns_, now_t_ns) >= settings_.min_interval_s;
}

bool OrderGate::answered(std::int64_t kick_id) const {
  return std::find(answered_.begin(), answered_.end(), kick_id) != answered_.end();
}

bool OrderGate::ready(std::int64_t now_t_ns) const {
  return sound(now_t_ns) && armed() && rested(now_t_ns) && charged();
}

msg::Refusal OrderGate::reason(const msg::KickOrder& order, std::int64_t now_t_ns) const {
  if (sample_ && !sound(now_t_ns)) return msg::REFUSAL_FAULT;
  if (!std::isfinite(order.power) || order.power < power_.min || order.power > power_.max)
    return msg::REFUSAL_OUT_OF_RANGE;
  if (!armed()) return msg::REFUSAL_UNARMED;
  const double ahead_s = seconds_from(now_t_ns, std::max(order.t_ns, order.fire_t_ns));
  if (now_t_ns > order.valid_until_t_ns || ahead_s > settings_.future_tolerance_s) return msg::REFUSAL_STALE;
  const double after_s = seconds_from(order.t_ns, order.fire_t_ns);
  if (!(after_s >= 0.0 && after_s <= cycle_s_ + kClockStep_s)) return msg::REFUSAL_STALE;
  if (answered(order.kick_id) || !rested(now_t_ns)) return msg::REFUSAL_DOUBLE;
  if (!charged()) return msg::REFUSAL_CHARGING;
  return msg::REFUSAL_NONE;
}

msg::Refusal OrderGate::judge(const msg::KickOrder& order, std::int64_t now_t_ns) {
  const msg::Refusal refusal = reason(order, now_t_ns);
  ++handled_;
  if (!answered(order.kick_id)) {
    answered_[oldest_] = order.kick_id;
    oldest_ = (oldest_ + 1) % kRemembered;
  }
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
  if (!accepted_ || accepted_->fire_t_ns <= now_t_ns || (sound(now_t_ns) && armed())) return std::nullopt;
  const Withdrawal withdrawal{accepted_->kick_id, accepted_->order_t_ns,
                              sound(now_t_ns) ? msg::REFUSAL_UNARMED : msg::REFUSAL_FAULT};
  last_fire_t_ns_ = accepted_->fire_before_t_ns;
  if (last_kick_id_ == accepted_->kick_id) last_accepted_ = false;
  ++refused_;
  accepted_.reset();
  return withdrawal;
}

}  // namespace trivela::nodes
