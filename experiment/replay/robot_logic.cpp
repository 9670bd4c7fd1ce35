#include "experiment/replay/robot_logic.hpp"

namespace trivela::experiment {
namespace {

constexpr double kOld_s = 1e3;  // older than any policy decides on

}  // namespace

RobotLogic::RobotLogic(const config::Settings& settings, const config::Robot& robot, std::uint8_t robot_id,
                       std::uint32_t session)
    : set_pieces_(settings.policy.rules.set_piece_s > 0.0),
      learns_(settings.self_calibration.mode == config::SelfCalibrationMode::kOn),
      robot_id_(robot_id),
      model_(settings.world_state, robot.model.ball_offset_m),
      decider_({settings.kick_decision, settings.policy, settings.goal}, robot.model, robot_id, session) {}

msg::WorldState RobotLogic::believe(const msg::Odometry& odometry, const BeliefInputs& inputs) {
  std::optional<msg::Referee> stopped;
  if (inputs.referee != nullptr && inputs.referee_silent) {
    stopped = *inputs.referee;
    stopped->playing = false;
  }
  msg::WorldState world = model_.update(odometry, inputs.frame, stopped ? &*stopped : inputs.referee, inputs.kicker);
  world.robot_id = robot_id_;
  return world;
}

LogicDecision RobotLogic::decide(const msg::WorldState& world, const DecisionInputs& inputs) {
  const auto own_kick_id = [this](std::int64_t recorded) {
    const auto own = own_kick_ids_.find(recorded);
    return own == own_kick_ids_.end() ? recorded : own->second;
  };
  std::optional<msg::KickerStatus> kicker;
  if (inputs.kicker != nullptr) {
    kicker = *inputs.kicker;
    kicker->last_kick_id = own_kick_id(kicker->last_kick_id);
  }
  std::optional<msg::KickOutcome> outcome;
  if (inputs.outcome != nullptr) {
    outcome = *inputs.outcome;
    outcome->kick_id = own_kick_id(outcome->kick_id);
  }
  if (learns_ && inputs.estimate != nullptr && decider_.is_news(*inputs.estimate, world.t_ns))
    decider_.learn(*inputs.estimate);
  if (set_pieces_ && inputs.referee != nullptr) decider_.receive(*inputs.referee);
  const robot::CycleDecision& decision =
      decider_.decide(world, kicker ? &*kicker : nullptr, outcome, nullptr, inputs.late ? kOld_s : 0.0);
  decider_.commit();
  if (decision.order && inputs.recorded_kick_id != 0) own_kick_ids_[inputs.recorded_kick_id] = decision.order->kick_id;
  return {decider_.record(world, kicker ? &*kicker : nullptr), decision.order, decision.output.drive};
}

}  // namespace trivela::experiment
