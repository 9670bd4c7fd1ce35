#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "config/robot.hpp"
#include "config/settings.hpp"
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

}  // namespace trivela::experiment
