#pragma once

#include <cstdint>
#include <optional>

#include "config/settings.hpp"
#include "hal/kicker.hpp"
#include "idl/messages.hpp"
#include "kicking/model/robot_model.hpp"
#include "robot/driver/order_gate.hpp"

namespace trivela::robot {

/// The kicker's driver without bus and device: samples and the referee's word in, statuses out; orders in, receipts
/// out. Whoever owns it fires what it accepts. Every now_t_ns is of the clock that the samples' and orders' t_ns are
/// of, and never falls behind it: the steady clock, in lockstep the sample's.
class OrderDesk {
 public:
  OrderDesk(const config::KickerDriver& settings, double cycle_s, const kicking::RobotModel& model,
            std::uint8_t robot_id);

  msg::KickerStatus status(const hal::KickerSample& sample, RefereeSays says, std::int64_t now_t_ns);

  /// Judges the order; where it is accepted, the device is to be given receipt.power at receipt.fired_t_ns, which is
  /// now or the order's own instant if that lies ahead. The steady clock's fields are its owner's.
  msg::KickReceipt answer(const msg::KickOrder& order, std::int64_t now_t_ns, OrderBy by = OrderBy::kOwnDecision);

  /// What the referee's word permits by now.
  void referee(RefereeSays says) { gate_.referee(says); }

  /// A second receipt, which refuses an accepted order after all: its instant lies ahead, and by now the game stands or
  /// the device is not well. The device is to be told. To be asked after every status() and referee().
  std::optional<msg::KickReceipt> withdrawal(std::int64_t now_t_ns);

  std::uint32_t handled() const { return gate_.handled(); }

  /// Kicks given to the device so far.
  std::uint32_t fires() const { return gate_.handled() - gate_.refused(); }

 private:
  OrderGate gate_;
  std::int64_t delay_ns_;
  std::uint8_t robot_id_;
  std::uint64_t statuses_ = 0;
  std::uint64_t receipts_ = 0;
};

}  // namespace trivela::robot
