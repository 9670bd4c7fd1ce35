#include "nodes/odometry/odometry_node.hpp"

#include <cmath>
#include <utility>

#include "hal/open.hpp"
#include "kicking/geometry/time.hpp"
#include "nodes/runtime/node_main.hpp"
#include "nodes/runtime/readers.hpp"
#include "nodes/runtime/step_done.hpp"

namespace trivela::nodes {
OdometryNode::OdometryNode(NodeContext& context, std::unique_ptr<hal::Wheels> wheels)
    : context_(context),
      wheels_(std::move(wheels)),
      odometry_(context.robot.base, context.settings.odometry),
      node_(context.participant, "odometry", context.robot_id()),
      odometry_out_(node_.writer<msg::Odometry>()),
      emulation_(context, node_),
      step_done_(step_done_writer(context, node_)),
      first_(context.settings.run.lockstep) {
  refuse_twin(context_, odometry_out_, "odometry");
  node_.on_device(
      "wheels", [this](std::chrono::nanoseconds timeout) { return next_sample(timeout); },
      [this](const hal::WheelSample& sample) { on_wheels(sample); },
      bus::writes<msg::Odometry, msg::DeviceDrive, msg::DeviceEmulated>());
  node_.on<msg::DriveCommand>([this](const msg::DriveCommand& command) { on_drive(command); },
                              bus::writes<msg::DeviceDrive, msg::StepDone>());
}

/// In lockstep the next sample waits for the drive command of the last one: a replayed log knows no other pace.
std::optional<hal::WheelSample> OdometryNode::next_sample(std::chrono::nanoseconds timeout) {
  if (wheels_->ended()) {
    context_.idle(timeout);
    return std::nullopt;
  }
  if (context_.settings.run.lockstep && !cycle_over_.try_acquire_for(timeout)) return std::nullopt;
  auto sample = wheels_->read(timeout);
  say_status(sample.has_value());
  if (!sample) stop_without_commands();
  if (!sample && context_.settings.run.lockstep) cycle_over_.release();
  return sample;
}

/// What the device says of its link and of its motors, whenever that is something else.
void OdometryNode::say_status(bool heard) {
  std::string said = wheels_->status();
  if (said == status_said_) return;
  status_said_ = std::move(said);
  if (!status_said_.empty()) context_.logger->log(heard ? spdlog::level::info : spdlog::level::warn, "{}", status_said_);
}

void OdometryNode::on_wheels(const hal::WheelSample& sample) {
  first_.once([this] {
    expect_device(*wheels_);
    expect_readers(context_, odometry_out_);
  });
  emulation_.see(msg::PART_WHEELS, sample.emulated, sample.t_ns);
  emulation_.see(msg::PART_GYRO, sample.gyro_emulated, sample.t_ns);
  auto out = odometry_.update(sample);
  if (!out) {
    context_.logger->warn("wheel sample of t {} ns is unusable: not finite, too few wheels, or not newer", sample.t_ns);
    return;
  }
  out->robot_id = context_.robot_id();
  out->seq = ++seq_;
  out->obeyed = obeyed();
  odometry_out_.write(*out);
  stop_without_commands();
}

msg::DriveSource OdometryNode::obeyed() {
  const std::lock_guard lock{drive_mutex_};
  return driving_ ? msg::DRIVE_KICK_DECISION : msg::DRIVE_NOBODY;
}

/// A robot that nobody drives any more stands still. In lockstep the next command is waited for instead.
void OdometryNode::stop_without_commands() {
  if (context_.settings.run.lockstep) return;
  const std::lock_guard lock{drive_mutex_};
  const std::int64_t now_ns = context_.steady_ns();
  const double silence_s = kicking::seconds(now_ns - commanded_t_ns_);
  if (!driving_ || silence_s <= context_.settings.odometry.drive_timeout_s) return;
  driving_ = false;
  wheels_->drive({}, now_ns);
  context_.logger->warn("no drive command for {:.2f} s: the base stops", silence_s);
}

void OdometryNode::on_drive(const msg::DriveCommand& command) {
  {
    const std::lock_guard lock{drive_mutex_};
    const bool real_time = !context_.settings.run.lockstep;
    const std::int64_t now_ns = real_time ? context_.steady_ns() : command.t_ns;
    // One that waited for this process to go on is of a moment that has passed.
    if (std::abs(kicking::seconds(now_ns - command.t_ns)) <= context_.settings.odometry.drive_timeout_s) {
      commanded_t_ns_ = command.t_ns;
      driving_ = true;
      wheels_->drive({command.vx_mps, command.vy_mps, command.omega_radps}, command.t_ns);
    }
  }
  step_done(step_done_, context_.robot_id(), msg::STEP_ODOMETRY, command.t_ns);
  if (context_.settings.run.lockstep) cycle_over_.release();
}

int odometry_main(int argc, char** argv) {
  return node_main(argc, argv, "odometry", [](NodeContext& context) {
    OdometryNode node{context, hal::open_wheels(context.settings.hal,
                                                {context.participant, context.robot_id(), context.robot.base})};
    run(context, node.node());
  });
}

}  // namespace trivela::nodes
