#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "config/settings.hpp"
#include "hal/kicker.hpp"
#include "idl/messages.hpp"
#include "kicking/model/robot_model.hpp"
#include "robot/driver/kicker_machine.hpp"
#include "robot/driver/order_gate.hpp"

namespace trivela::robot {

/// The robot's own decision node, as the driver knows it. Before it was heard nothing is charged, and nothing emptied.
enum class DecisionNode : std::uint8_t { kUnheard, kThere, kLost };

/// The kicker's driver without bus and device: samples and the referee's word in, statuses out; orders in, receipts
/// out; and what the capacitor shall do. The OrderGate judges orders, by the same facts that move the state machine:
/// none is accepted but in STATE_READY. Whoever owns it fires what it accepts. Every now_t_ns is of the clock that the
/// samples' and orders' t_ns are of, and never falls behind it: the steady clock, in lockstep the sample's.
class KickerController {
 public:
  /// `decision`: what is known of the decision node at first.
  KickerController(const config::KickerDriver& settings, double cycle_s, const kicking::RobotModel& model,
                   std::uint8_t robot_id, DecisionNode decision = DecisionNode::kUnheard);

  /// The program begins in the place of one that ended unseen, whose last kick may have up to a cycle to go: none is
  /// fired before min_interval_s after that.
  void began(std::int64_t now_t_ns);

  msg::KickerStatus status(const hal::KickerSample& sample, RefereePermission says, std::int64_t now_t_ns);

  /// Judges the order; where it is accepted, the device is to be given receipt.power at receipt.fired_t_ns, which is
  /// now or the order's own instant if that lies ahead. The steady clock's fields are its owner's.
  msg::KickReceipt answer(const msg::KickOrder& order, std::int64_t now_t_ns, OrderBy by);

  /// What is known of the decision node by now; an order alone is no sign that it lives. To be followed by
  /// charge_command().
  void decision_node(DecisionNode known, std::int64_t now_t_ns);

  /// An accepted order's instant lies ahead, or its pulse runs.
  bool firing() const { return stand_.state == msg::STATE_FIRING; }

  /// What the capacitor shall do by now.
  hal::ChargeCommand charge_command() const { return stand_.word; }

  /// The program ends: from now on the capacitor is to be emptied.
  hal::ChargeCommand end();

  /// What the referee's word permits by now.
  void referee(RefereePermission says) { gate_.referee(says); }

  /// A second receipt, which refuses an accepted order after all: its instant lies ahead, and by now the game stands or
  /// the device is not well. The device is to be told. To be asked after every status() and referee().
  std::optional<msg::KickReceipt> withdrawal(std::int64_t now_t_ns);

  /// What became of a shot that the device was given. A second receipt where it was not fired: `refusal` is stale,
  /// unarmed or fault. A shot that was fired late moves the next one.
  std::optional<msg::KickReceipt> result(const hal::ShotResult& result, std::int64_t now_t_ns);

  /// A second receipt of a kick that a driver before this one accepted and did not tell the device of.
  msg::KickReceipt not_fired(const msg::KickReceipt& accepted, std::int64_t now_t_ns);

  /// The same where that driver ended while it told the device: the kick still counts, `refusal` is not_known.
  msg::KickReceipt not_known(const msg::KickReceipt& accepted, std::int64_t now_t_ns);

  std::uint32_t handled() const { return gate_.handled(); }

  /// Kicks given to the device so far.
  std::uint32_t fires() const { return gate_.handled() - gate_.refused(); }

 private:
  void happened(KickerEvent event) { stand_ = next(stand_, event); }
  void advance(std::int64_t now_t_ns);
  msg::KickReceipt refused_after_all(const OrderGate::Withdrawal& withdrawn, std::int64_t now_t_ns);
  msg::KickReceipt refusal_of(const OrderGate::Withdrawal& withdrawn, std::int64_t now_t_ns);

  OrderGate gate_;
  KickerMachineState stand_;
  VoltageWatch voltage_;
  bool over_voltage_ = false;
  DecisionNode decision_;
  std::int64_t cycle_ns_;
  std::vector<std::int64_t> delays_ns_;  // of each kind of kick
  std::uint8_t robot_id_;
  std::uint64_t statuses_ = 0;
  std::uint64_t receipts_ = 0;
};

}  // namespace trivela::robot
