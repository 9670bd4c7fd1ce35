#include "experiment/play/in_process_robot.hpp"

#include <utility>

#include "emulators/sim/sim_messages.hpp"
#include "experiment/play/oracle.hpp"
#include "kicking/in_place.hpp"

namespace trivela::experiment {
namespace {

hal::WheelSample wheel_sample(const sim::Sensors& sensors) {
  return {sensors.t_ns, sensors.wheels.wheel_count, sensors.wheels.wheel_radps, sensors.wheels.gyro_radps};
}

hal::KickerSample kicker_sample(const sim::Sensors& sensors) {
  return {.t_ns = sensors.t_ns,
          .charge = sensors.kicker.charge,
          .armed = sensors.kicker.armed,
          .lever_kind = sensors.kicker.lever_kind};
}

}  // namespace

InProcessRobot::InProcessRobot(const config::Settings& settings, const config::Robot& robot, std::uint8_t robot_id,
                               std::uint32_t session, std::optional<robot::GroundTruthPolicy> oracle)
    : robot_(robot),
      robot_id_(robot_id),
      odometry_(robot.base, settings.odometry),
      decider_({settings.kick_decision, settings.policy, settings.goal}, robot_.model, robot_id, session,
               std::move(oracle)),
      model_(settings.world_state, robot.model.ball_offset_m, decider_.reads_opponents()),
      controller_(settings.kicker_driver, settings.run.cycle_s, robot.model, robot_id, robot::DecisionNode::kThere),
      arbiter_(settings.kick_decision.drive, settings.odometry) {}

const robot::CycleDecision* InProcessRobot::cycle(const sim::Sensors& sensors, const msg::Referee& referee,
                                                  const std::optional<msg::KickOutcome>& outcome,
                                                  const sim::TrueState* truth) {
  receipt_.reset();
  const hal::KickerSample kicker = kicker_sample(sensors);
  const msg::VisionFrame frame = hal::vision_message(sensors.t_ns, sensors.vision);
  const msg::Odometry* const odometry = odometry_.update(wheel_sample(sensors));
  if (odometry == nullptr) return nullptr;
  const auto says = referee.playing ? robot::RefereePermission::kPlay : robot::RefereePermission::kStop;
  kicking::make_in_place(status_, [&] { return controller_.status(kicker, says, sensors.t_ns); });
  kicking::make_in_place(world_, [&] { return model_.update(*odometry, &frame, &referee, &status_); });
  world_.robot_id = robot_id_;
  if (truth != nullptr)
    told_ = oracle_input(*truth, sensors.t_ns, referee.playing, referee.possession_id, status_.ready);
  decider_.receive(referee);
  const robot::CycleDecision& decision =
      decider_.decide(world_, &status_, outcome, truth != nullptr ? &told_ : nullptr);
  decider_.commit();
  if (decision.order) receipt_ = controller_.answer(*decision.order, sensors.t_ns, robot::OrderBy::kOwnDecision);
  arbiter_.receive(msg::DRIVE_KICK_DECISION, sensors.t_ns, decision.output.drive, sensors.t_ns);
  kicking::make_in_place(drive_, [&] { return arbiter_.decide(sensors.t_ns, {world_.playing, world_.possession}); });
  return &decision;
}

}  // namespace trivela::experiment
