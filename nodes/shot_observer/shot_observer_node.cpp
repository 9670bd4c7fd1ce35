#include "nodes/shot_observer/shot_observer_node.hpp"

#include <cmath>
#include <limits>

#include "nodes/runtime/step_done.hpp"

namespace trivela::nodes {
namespace {

static_assert(int{msg::OUTCOME_ON_TARGET} == int(kicking::Outcome::kOnTarget));
static_assert(int{msg::OUTCOME_UNKNOWN} == int(kicking::Outcome::kUnknown));

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

msg::KickOutcome message(const TrackedShot& shot) {
  msg::KickOutcome out{};
  out.t_ns = shot.t_ns;
  out.kick_id = shot.kick_id;
  out.outcome = static_cast<msg::Outcome>(shot.verdict.outcome);
  out.on_target = shot.verdict.outcome == kicking::Outcome::kOnTarget;
  out.x_cross_m = shot.verdict.x_cross_m.value_or(kNone);
  out.z_cross_m = shot.verdict.z_cross_m.value_or(kNone);
  out.sd_cross_m = shot.verdict.sd_cross_m.value_or(kNone);
  out.observations = static_cast<std::uint32_t>(shot.sightings);
  out.exit_speed_mps = shot.verdict.exit_speed_mps.value_or(kNone);
  out.exit_elevation_rad = shot.verdict.exit_elevation_rad.value_or(kNone);
  return out;
}

}  // namespace

ShotObserverNode::ShotObserverNode(NodeContext& context)
    : context_(context),
      tracker_(context.settings.shot_observer, context.settings.goal),
      node_(context.participant, "shot_observer", context.robot_id()),
      outcome_out_(node_.writer<msg::KickOutcome>()),
      step_done_(step_done_writer(context, node_)),
      referee_(node_.stores<msg::Referee>()),
      first_(context.settings.run.lockstep) {
  refuse_twin(context_, outcome_out_, "shot_observer");
  node_.on<msg::KickReceipt>([this](const msg::KickReceipt& receipt) { on_receipt(receipt); },
                             bus::writes<msg::KickOutcome>());
  node_.on<msg::FlightFrame>([this](const msg::FlightFrame& frame) { on_frame(frame); },
                             bus::writes<msg::KickOutcome, msg::StepDone>());
}

void ShotObserverNode::on_receipt(const msg::KickReceipt& receipt) {
  if (!receipt.accepted) return;
  const auto& model = context_.robot.model;
  const double expected_mps = model.table.speed_for(receipt.power) * std::cos(model.exit_angle_at(receipt.power));
  const std::lock_guard lock{mutex_};
  publish(tracker_.release(receipt.kick_id, receipt.release_t_ns, expected_mps));
}

void ShotObserverNode::on_frame(const msg::FlightFrame& frame) {
  first_.once([this] {
    expect_readers(outcome_out_, 2);  // kick_decision, recorder
  });
  const auto referee = input_of_cycle(context_, *referee_, frame.t_ns);
  if (!referee || referee->playing) {
    stopped_t_ns_.reset();
  } else if (!stopped_t_ns_) {
    stopped_t_ns_ = referee->t_ns;
  }
  {
    const std::lock_guard lock{mutex_};
    if (stopped_t_ns_ && frame.t_exposure_ns >= *stopped_t_ns_) publish(tracker_.stopped(*stopped_t_ns_));
    publish(tracker_.frame(frame.t_exposure_ns, frame.ball_seen ? std::optional{Eigen::Vector3d{
                                                                      frame.ball_x_m, frame.ball_y_m, frame.ball_z_m}}
                                                                : std::nullopt));
  }
  step_done(step_done_, context_.robot_id(), msg::STEP_SHOT_OBSERVER, frame.t_ns);
}

void ShotObserverNode::publish(const std::vector<TrackedShot>& settled) {
  for (const TrackedShot& shot : settled) {
    msg::KickOutcome out = message(shot);
    out.robot_id = context_.robot_id();
    out.seq = ++seq_;
    outcome_out_.write(out);
    context_.logger->info("kick {}: {}", shot.kick_id, kicking::name(shot.verdict.outcome));
  }
}

}  // namespace trivela::nodes
