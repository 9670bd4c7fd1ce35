#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "config/robot.hpp"
#include "config/settings.hpp"
#include "experiment/replay/input_stream.hpp"
#include "idl/messages.hpp"
#include "robot/belief/world_model.hpp"
#include "robot/decision/decider.hpp"

namespace trivela::experiment {

/// What a robot's world_state node had in a cycle; nullptr: nothing yet.
struct BeliefInputs {
  const msg::VisionFrame* frame = nullptr;
  const msg::Referee* referee = nullptr;
  const msg::KickerStatus* kicker = nullptr;
  bool referee_silent = false;  ///< nobody plays by its last word
};

/// What its kick_decision node had.
struct DecisionInputs {
  const msg::KickerStatus* kicker = nullptr;
  const msg::Referee* referee = nullptr;
  const msg::KickOutcome* outcome = nullptr;
  const msg::KickerEstimate* estimate = nullptr;
  bool late = false;                  ///< the node came to the world state when that was old
  std::int64_t recorded_kick_id = 0;  ///< the kick that was ordered in this cycle; 0: none
};

/// What a cycle's logic says.
struct LogicDecision {
  msg::KickDecision record;
  std::optional<msg::KickOrder> order;
  kicking::Twist drive;
};

/// A robot's belief and decisions in process, as its nodes make them: a cycle's inputs in, world state and decision
/// out. It can be copied, to try a cycle with other inputs. The robot outlives it.
class RobotLogic {
 public:
  /// `session`: upper 15 bits of every kick_id. Throws config::Error where the policies make no sense together.
  RobotLogic(const config::Settings& settings, const config::Robot& robot, std::uint8_t robot_id,
             std::uint32_t session);

  msg::WorldState believe(const msg::Odometry& odometry, const BeliefInputs& inputs);
  LogicDecision decide(const msg::WorldState& world, const DecisionInputs& inputs);

 private:
  bool set_pieces_;
  bool learns_;  // decisions go by what was learned of the kicker
  std::uint8_t robot_id_;
  robot::WorldModel model_;
  robot::Decider decider_;
  std::map<std::int64_t, std::int64_t> own_kick_ids_;  // by that of the kick recorded in the same cycle
};

/// How far the log's own settings give again what was recorded.
struct ReplayCheck {
  std::int64_t cycles = 0;            ///< with a wheel sample
  std::int64_t beliefs = 0;           ///< recorded world states of these cycles
  std::int64_t beliefs_same = 0;      ///< of them, to the last bit
  std::int64_t decisions = 0;         ///< recorded decisions
  std::int64_t decisions_same = 0;    ///< of them: the same policy, fire or hold, reason and power
  std::int64_t decisions_exact = 0;   ///< of them: the same in every number
  std::int64_t crossed = 0;           ///< cycles in which another sample counted than the latest by its instant
  std::int64_t late = 0;              ///< cycles that the decision node came to late
  std::int64_t without_odometry = 0;  ///< recorded decisions of cycles whose wheel sample is not in the log
};

/// The cycles of a recorded robot with what its nodes had in each.
///
/// In lockstep that is what the cycle's instant has. In real time each node takes the latest sample that has reached
/// it, and a log has instants, not arrivals: of samples within 500 ms of a cycle nobody knows beforehand whether
/// they were there. The logic with the log's own settings finds out: of all possible inputs those count with which it
/// comes nearest to the recorded world state, then to the recorded decision.
class RecordedCycles {
 public:
  /// `settings` and `robot`: of the log. All must outlive the object. Throws config::Error and std::runtime_error.
  RecordedCycles(const RecordedRobot& recorded, const config::Settings& settings, const config::Robot& robot,
                 std::uint32_t session);

  /// Goes on to the next cycle; false: there is none. Throws std::runtime_error where the log cannot be read.
  bool next();

  const msg::Odometry& odometry() const { return odometry_; }
  BeliefInputs belief_inputs() const;
  DecisionInputs decision_inputs() const;

  /// What the log's own settings give.
  const msg::WorldState& world() const { return world_; }
  const LogicDecision& decided() const { return *decided_; }

  const ReplayCheck& check() const { return check_; }

 private:
  void find_belief();
  void find_decision();

  bool lockstep_;
  std::uint8_t robot_id_;
  std::unique_ptr<RobotLogic> logic_;
  RowPages<msg::Odometry> odometries_;
  RowPages<msg::WorldState> worlds_;
  RowPages<msg::KickDecision> decisions_;
  InputStream<msg::VisionFrame> frames_;
  InputStream<msg::Referee> referee_, decision_referee_;
  InputStream<msg::KickerStatus> kicker_, decision_kicker_;
  InputStream<msg::KickOutcome> outcomes_;
  InputStream<msg::KickerEstimate> estimates_;
  msg::Odometry odometry_{};
  std::optional<msg::WorldState> recorded_world_;
  std::optional<msg::KickDecision> recorded_decision_;
  msg::WorldState world_{};
  std::optional<LogicDecision> decided_;
  bool referee_silent_ = false, late_ = false, crossed_ = false;
  ReplayCheck check_;
};

}  // namespace trivela::experiment
