#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "config/settings.hpp"
#include "idl/messages.hpp"
#include "kicking/learning/kicker_learner.hpp"

namespace trivela::robot {

/// What a robot learns of its kicker, without a bus: its own decisions, receipts and outcomes in, estimates out.
class KickLearning {
 public:
  /// `model`: of the robot's file; it must outlive the object.
  KickLearning(const config::SelfCalibration& settings, const kicking::RobotModel& model, std::uint8_t robot_id);

  /// Before the first kick: what the file, or an earlier estimate, says.
  const msg::KickerEstimate& first() const { return message_; }
  void begin_with(const kicking::KickerEstimate& earlier);

  /// Kept until the outcome is known, in whatever order they come.
  void receive(const msg::KickDecision& decision);
  void receive(const msg::KickReceipt& receipt);

  /// The estimate after an outcome of cycle t_ns; none: it says nothing of the kicker, or of no kick that is known.
  std::optional<msg::KickerEstimate> seen(const msg::KickOutcome& outcome, std::int64_t t_ns);

 private:
  kicking::KickerLearner learner_;
  std::deque<msg::KickDecision> decisions_;
  std::deque<msg::KickReceipt> receipts_;
  msg::KickerEstimate message_{};
};

/// The estimate of a message.
kicking::KickerEstimate estimate_of(const msg::KickerEstimate& message);

}  // namespace trivela::robot
