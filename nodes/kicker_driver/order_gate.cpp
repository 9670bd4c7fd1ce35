#include "nodes/kicker_driver/order_gate.hpp"

#include <cmath>

namespace trivela::nodes {
namespace {

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

}  // namespace

bool OrderGate::sound(std::int64_t now_t_ns) const {
  return sample_ && sample_->fault == hal::KickerFault::kNone &&
         seconds(now_t_ns - sample_->t_ns) <= settings_.link_timeout_s;
}

bool OrderGate::rested(std::int64_t now_t_ns) const {
  return !last_fire_t_ns_ || seconds(now_t_ns - *last_fire_t_ns_) >= settings_.min_interval_s;
}

bool OrderGate::ready(std::int64_t now_t_ns) const {
  return sound(now_t_ns) && armed() && rested(now_t_ns) && charged();
}

msg::Refusal OrderGate::reason(const msg::KickOrder& order, std::int64_t now_t_ns) const {
  if (sample_ && !sound(now_t_ns)) return msg::REFUSAL_FAULT;
  if (!std::isfinite(order.power) || order.power < power_.min || order.power > power_.max)
    return msg::REFUSAL_OUT_OF_RANGE;
  if (!armed()) return msg::REFUSAL_UNARMED;
  if (now_t_ns > order.valid_until_t_ns || seconds(order.t_ns - now_t_ns) > settings_.future_tolerance_s) {
    return msg::REFUSAL_STALE;
  }
  if (order.kick_id == last_kick_id_ || !rested(now_t_ns)) return msg::REFUSAL_DOUBLE;
  if (!charged()) return msg::REFUSAL_CHARGING;
  return msg::REFUSAL_NONE;
}

msg::Refusal OrderGate::judge(const msg::KickOrder& order, std::int64_t now_t_ns) {
  const msg::Refusal refusal = reason(order, now_t_ns);
  ++handled_;
  last_kick_id_ = order.kick_id;
  last_accepted_ = refusal == msg::REFUSAL_NONE;
  if (last_accepted_) {
    last_fire_t_ns_ = now_t_ns;
  } else {
    ++refused_;
  }
  return refusal;
}

}  // namespace trivela::nodes
