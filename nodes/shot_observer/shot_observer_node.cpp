#include "nodes/shot_observer/shot_observer_node.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

#include "config/kicker_state.hpp"
#include "config/text/error.hpp"
#include "nodes/runtime/lockstep.hpp"
#include "nodes/runtime/node_main.hpp"
#include "nodes/runtime/readers.hpp"

namespace trivela::nodes {
ShotObserverNode::ShotObserverNode(NodeContext& context)
    : context_(context),
      observer_(context.settings.shot_observer, context.settings.goal),
      node_(context.participant, "shot_observer", context.robot_id()),
      outcome_out_(node_.writer<msg::KickOutcome>()),
      step_done_(step_done_writer(context, node_)),
      referee_(node_.stores<msg::Referee>()),
      first_(context.settings.run.lockstep) {
  reject_duplicate_node(context_, outcome_out_, "shot_observer");
  if (context.settings.self_calibration.mode != config::SelfCalibrationMode::kOff) begin_learning();
  node_.on<msg::KickDecision>([this](const msg::KickDecision& decision) { on_decision(decision); });
  node_.on<msg::KickReceipt>([this](const msg::KickReceipt& receipt) { on_receipt(receipt); },
                             bus::writes<msg::KickOutcome, msg::KickerEstimate>());
  node_.on<msg::FlightFrame>([this](const msg::FlightFrame& frame) { on_frame(frame); },
                             bus::writes<msg::KickOutcome, msg::KickerEstimate, msg::StepDone>());
  if (!learning_) return;
  msg::KickerEstimate first = learning_->first();
  if (!context.settings.run.lockstep) first.t_ns = context.steady_ns();
  say(first);
}

/// With the robot's file, or with what an earlier match left.
void ShotObserverNode::begin_learning() {
  const config::SelfCalibration& settings = context_.settings.self_calibration;
  learning_.emplace(settings, context_.robot.model, context_.robot_id());
  estimate_out_.emplace(node_.writer<msg::KickerEstimate>());
  if (settings.state_file.empty()) return;
  try {
    const auto earlier = config::load_kicker_state(settings.state_file, context_.robot, context_.settings.run.robot_id,
                                                   settings.state_max_age_h, std::chrono::system_clock::now());
    if (earlier) learning_->begin_with(*earlier);
    context_.logger->info("self-calibration begins with {}", earlier ? settings.state_file : "the robot's file");
  } catch (const config::Error& error) {
    context_.logger->warn("self-calibration begins with the robot's file: {}", error.what());
    keep_refused_state();
  }
}

/// It may be the only one of another robot.
void ShotObserverNode::keep_refused_state() {
  const std::string& file = context_.settings.self_calibration.state_file;
  try {
    context_.logger->warn("{} is now {}", file, config::set_kicker_state_aside(file).string());
  } catch (const config::Error& error) {
    context_.logger->warn("self-calibration is not kept: {}", error.what());
    keeps_ = false;
  }
}

void ShotObserverNode::on_decision(const msg::KickDecision& decision) {
  if (!learning_ || !decision.fire || !context_.participant.believes(decision.t_ns)) return;
  const std::lock_guard lock{mutex_};
  learning_->receive(decision);
}

void ShotObserverNode::on_receipt(const msg::KickReceipt& receipt) {
  if (!context_.participant.believes(receipt.release_t_ns)) return;
  const std::lock_guard lock{mutex_};
  publish(observer_.receipt(receipt, context_.robot.model), receipt.order_t_ns);
  if (learning_) learning_->receive(receipt);
}

void ShotObserverNode::on_frame(const msg::FlightFrame& frame) {
  first_.once([this] {
    expect_readers(context_, outcome_out_);
    if (!learning_) return;
    expect_readers(context_, *estimate_out_);
    await_readers();
  });
  auto referee = input_of_cycle(context_, *referee_, frame.t_ns);
  if (!context_.participant.believes(frame.t_exposure_ns)) return;
  if (referee && !context_.participant.believes(referee->t_ns)) referee.reset();
  {
    const std::lock_guard lock{mutex_};
    publish(observer_.frame(frame, referee), frame.t_ns);
  }
  step_done(step_done_, context_.robot_id(), msg::STEP_SHOT_OBSERVER, frame.t_ns);
}

void ShotObserverNode::publish(std::vector<msg::KickOutcome> settled, std::int64_t t_ns) {
  for (msg::KickOutcome& outcome : settled) {
    outcome.robot_id = context_.robot_id();
    outcome.seq = ++seq_;
    outcome_out_.write(outcome);
    context_.logger->info("kick {}: {}", outcome.kick_id, bus::label(outcome.outcome));
    if (!learning_) continue;
    if (const auto estimate = learning_->seen(outcome, t_ns)) say(*estimate);
  }
}

void ShotObserverNode::say(const msg::KickerEstimate& estimate) {
  estimate_out_->write(estimate);
  const bool decides = context_.settings.self_calibration.mode == config::SelfCalibrationMode::kOn;
  if (decides && context_.settings.run.lockstep) await_readers();
  if (estimate.kick_id != 0) keep(estimate);
}

/// In lockstep everybody has the first estimate before play begins, and, where decisions go by them, each before the
/// cycle ends: the next decision is the same on every machine. That takes some 50 ms of real time.
void ShotObserverNode::await_readers() {
  if (!estimate_out_->wait_until_received(kLockstepTimeout))
    throw std::runtime_error{"kicker_estimate was not received within 20 s"};
}

/// For the next match. A disk that is full ends no match.
void ShotObserverNode::keep(const msg::KickerEstimate& estimate) {
  const std::string& file = context_.settings.self_calibration.state_file;
  if (file.empty() || !keeps_) return;
  try {
    config::save_kicker_state(file, robot::estimate_of(estimate), context_.robot, context_.settings.run.robot_id,
                              std::chrono::system_clock::now());
  } catch (const config::Error& error) {
    if (!std::exchange(not_kept_said_, true)) context_.logger->warn("self-calibration is not kept: {}", error.what());
  }
}

int shot_observer_main(int argc, char** argv) {
  return node_main(argc, argv, "shot_observer", [](NodeContext& context) {
    ShotObserverNode node{context};
    run(context, node.node());
  });
}

}  // namespace trivela::nodes
