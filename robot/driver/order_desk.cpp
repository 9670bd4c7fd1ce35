#include "robot/driver/order_desk.hpp"

#include <algorithm>

#include "idl/none.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

static_assert(int{msg::FAULT_NONE} == int(hal::KickerFault::kNone));
static_assert(int{msg::FAULT_LINK} == int(hal::KickerFault::kLink));

kicking::Range power_range(const kicking::EffectiveTable& table) { return {table.front().power, table.back().power}; }

}  // namespace

OrderDesk::OrderDesk(const config::KickerDriver& settings, double cycle_s, const kicking::RobotModel& model,
                     std::uint8_t robot_id)
    : gate_(settings, power_range(model.table), cycle_s),
      delay_ns_(kicking::nanoseconds(model.delay_s)),
      robot_id_(robot_id) {}

msg::KickerStatus OrderDesk::status(const hal::KickerSample& sample, RefereeSays says, std::int64_t now_t_ns) {
  gate_.device(sample);
  gate_.referee(says);
  msg::KickerStatus out{};
  out.robot_id = robot_id_;
  out.seq = ++statuses_;
  out.t_ns = sample.t_ns;
  out.charge = sample.charge;
  out.charge_modelled = sample.charge_modelled;
  out.voltage_v = msg::wire_of(sample.voltage_v);
  out.armed = gate_.armed();
  out.ready = gate_.ready(now_t_ns);
  out.fault = static_cast<msg::KickerFault>(sample.fault);
  out.state = out.fault != msg::FAULT_NONE ? msg::STATE_FAULT
              : !out.armed                 ? msg::STATE_OFF
              : out.ready                  ? msg::STATE_READY
                                           : msg::STATE_CHARGING;
  out.last_kick_id = gate_.last_kick_id();
  out.last_accepted = gate_.last_accepted();
  out.orders_handled = gate_.handled();
  out.orders_refused = gate_.refused();
  return out;
}

msg::KickReceipt OrderDesk::answer(const msg::KickOrder& order, std::int64_t now_t_ns, OrderBy by) {
  const msg::Refusal refusal = gate_.judge(order, now_t_ns, by);
  msg::KickReceipt receipt{};
  receipt.robot_id = robot_id_;
  receipt.seq = ++receipts_;
  receipt.t_ns = now_t_ns;
  receipt.kick_id = order.kick_id;
  receipt.accepted = refusal == msg::REFUSAL_NONE;
  receipt.refusal = refusal;
  receipt.order_t_ns = order.t_ns;
  if (!receipt.accepted) return receipt;
  receipt.power = order.power;
  receipt.fired_t_ns = std::max(now_t_ns, order.fire_t_ns);
  receipt.release_t_ns = receipt.fired_t_ns + delay_ns_;
  return receipt;
}

std::optional<msg::KickReceipt> OrderDesk::withdrawal(std::int64_t now_t_ns) {
  const auto withdrawn = gate_.withdraw(now_t_ns);
  if (!withdrawn) return std::nullopt;
  msg::KickReceipt receipt{};
  receipt.robot_id = robot_id_;
  receipt.seq = ++receipts_;
  receipt.t_ns = now_t_ns;
  receipt.kick_id = withdrawn->kick_id;
  receipt.refusal = withdrawn->reason;
  receipt.order_t_ns = withdrawn->order_t_ns;
  return receipt;
}

}  // namespace trivela::robot
