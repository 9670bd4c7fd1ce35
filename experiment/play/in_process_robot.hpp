#pragma once

#include <cstdint>
#include <optional>

#include "config/robot.hpp"
#include "config/settings.hpp"
#include "robot/belief/world_model.hpp"
#include "robot/decision/decider.hpp"
#include "robot/driver/kicker_controller.hpp"
#include "robot/odometry/drive_arbiter.hpp"
#include "robot/odometry/wheel_odometry.hpp"
#include "sim/sensors.hpp"
#include "sim/truth.hpp"

namespace trivela::experiment {

/// One robot's part of a lockstep cycle, without a bus: odometry, world model, decision, and the kicker's driver.
class InProcessRobot {
 public:
  /// `session`: upper 15 bits of every kick_id. `oracle`: where that policy may be in charge.
  InProcessRobot(const config::Settings& settings, const config::Robot& robot, std::uint8_t robot_id,
                 std::uint32_t session, std::optional<robot::GroundTruthPolicy> oracle);
  InProcessRobot(const InProcessRobot&) = delete;
  InProcessRobot& operator=(const InProcessRobot&) = delete;

  /// The referee's word before the first cycle, as a robot hears it that has no ball.
  void receive(const msg::Referee& word) { model_.receive(word); }

  /// What its kicker is by its kicks, from the next cycle on.
  void learn(const msg::KickerEstimate& estimate) { decider_.learn(estimate); }

  /// Decides the cycle of `sensors`. nullptr: its wheel sample is not newer than the last one.
  /// `truth`: of the same instant, where the oracle may be in charge.
  const robot::CycleDecision* cycle(const sim::Sensors& sensors, const msg::Referee& referee,
                                    const std::optional<msg::KickOutcome>& outcome, const sim::TrueState* truth);

  /// The driver's answer to the order of this cycle; none: it held.
  const std::optional<msg::KickReceipt>& receipt() const { return receipt_; }

  /// What the wheels are told in this cycle, where no team's program speaks.
  const robot::ObeyedDrive& drive() const { return drive_; }

  const msg::WorldState& world() const { return world_; }

  /// The record of this cycle's decision.
  msg::KickDecision record() const { return decider_.record(world_, &status_); }

  const robot::Decider& decider() const { return decider_; }
  const config::Robot& robot() const { return robot_; }

 private:
  config::Robot robot_;
  std::uint8_t robot_id_;
  robot::WheelOdometry odometry_;
  robot::Decider decider_;
  robot::WorldModel model_;
  robot::KickerController controller_;
  robot::DriveArbiter arbiter_;
  robot::ObeyedDrive drive_;
  msg::WorldState world_{};
  msg::KickerStatus status_{};
  kicking::PolicyInput told_;  // of the oracle
  std::optional<msg::KickReceipt> receipt_;
};

}  // namespace trivela::experiment
