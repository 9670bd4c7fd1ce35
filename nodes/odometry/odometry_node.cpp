#include "nodes/odometry/odometry_node.hpp"

#include <utility>

#include "hal/open.hpp"
#include "kicking/geometry/time.hpp"
#include "nodes/runtime/lockstep.hpp"
#include "nodes/runtime/node_main.hpp"
#include "nodes/runtime/readers.hpp"

namespace trivela::nodes {
OdometryNode::OdometryNode(NodeContext& context, std::unique_ptr<hal::Wheels> wheels)
    : context_(context),
      wheels_(std::move(wheels)),
      odometry_(context.robot.base, context.settings.odometry),
      node_(context.participant, "odometry", context.robot_id()),
      odometry_out_(node_.writer<msg::Odometry>()),
      emulation_(context, node_),
      step_done_(step_done_writer(context, node_)),
      first_(context.settings.run.lockstep),
      world_(node_.stores<msg::WorldState>()),
      arbiter_(context.settings.kick_decision.drive, context.settings.odometry) {
  reject_duplicate_node(context_, odometry_out_, "odometry");
  if (context_.settings.kick_decision.drive == config::DriveMode::kAdvice)
    context_.logger->info("kick_decision.drive = \"advice\": the base moves by team_drive alone");
  node_.on_device(
      "wheels", [this](std::chrono::nanoseconds timeout) { return next_sample(timeout); },
      [this](const hal::WheelSample& sample) { on_wheels(sample); },
      bus::writes<msg::Odometry, msg::DeviceDrive, msg::DeviceEmulated>());
  node_.on<msg::DriveCommand>([this](const msg::DriveCommand& command) { on_drive(command); },
                              bus::writes<msg::DeviceDrive, msg::StepDone>());
  node_.on<msg::TeamDrive>([this](const msg::TeamDrive& command) { on_team_drive(command); },
                           bus::writes<msg::DeviceDrive>());
}

/// In lockstep the next sample waits for the drive command of the last one.
std::optional<hal::WheelSample> OdometryNode::next_sample(std::chrono::nanoseconds timeout) {
  if (context_.settings.run.lockstep && !cycle_over_.try_acquire_for(timeout)) return std::nullopt;
  auto sample = wheels_->read(timeout);
  say_status(sample.has_value());
  if (!sample) stop_without_commands();
  if (!sample && context_.settings.run.lockstep) cycle_over_.release();
  return sample;
}

/// What the device says of its link and of its motors, whenever that is something else.
void OdometryNode::say_status(bool received) {
  std::string said = wheels_->status();
  if (said == status_said_) return;
  status_said_ = std::move(said);
  if (!status_said_.empty())
    context_.logger->log(received ? spdlog::level::info : spdlog::level::warn, "{}", status_said_);
}

void OdometryNode::on_wheels(const hal::WheelSample& sample) {
  first_.once([this] {
    expect_device(*wheels_);
    expect_readers(context_, odometry_out_);
  });
  emulation_.see(msg::PART_WHEELS, sample.emulated, sample.t_ns);
  emulation_.see(msg::PART_GYRO, sample.gyro_emulated, sample.t_ns);
  const msg::Odometry* const estimate = odometry_.update(sample);
  if (estimate == nullptr) {
    context_.logger->warn("wheel sample of t {} ns is unusable: not finite, too few wheels, or not newer", sample.t_ns);
    return;
  }
  msg::Odometry out = *estimate;
  out.robot_id = context_.robot_id();
  out.seq = ++seq_;
  out.obeyed = obeyed();
  odometry_out_.write(out);
  stop_without_commands();
}

msg::DriveSource OdometryNode::obeyed() {
  const std::lock_guard lock{drive_mutex_};
  return obeyed_;
}

/// A robot that nobody drives any more stands still. In lockstep the next command is waited for instead.
void OdometryNode::stop_without_commands() {
  if (context_.settings.run.lockstep) return;
  const std::lock_guard lock{drive_mutex_};
  drive_wheels(context_.steady_ns(), false);
}

/// Every cycle tells the wheels something; a command that waited for this process to go on is of a moment that has
/// passed, and none.
void OdometryNode::on_drive(const msg::DriveCommand& command) {
  {
    const std::lock_guard lock{drive_mutex_};
    const std::int64_t now_ns = context_.settings.run.lockstep ? command.t_ns : context_.steady_ns();
    if (arbiter_.receive(msg::DRIVE_KICK_DECISION, command.t_ns, {command.vx_mps, command.vy_mps, command.omega_radps},
                         now_ns))
      drive_wheels(now_ns, true);
  }
  step_done(step_done_, context_.robot_id(), msg::STEP_ODOMETRY, command.t_ns);
  if (context_.settings.run.lockstep) cycle_over_.release();
}

/// In lockstep it counts from the next cycle on.
void OdometryNode::on_team_drive(const msg::TeamDrive& command) {
  const std::lock_guard lock{drive_mutex_};
  const bool lockstep = context_.settings.run.lockstep;
  const std::int64_t now_ns = lockstep ? command.t_ns : context_.steady_ns();
  const kicking::Twist twist{command.vx_mps, command.vy_mps, command.omega_radps};
  if (!arbiter_.receive(msg::DRIVE_TEAM, command.t_ns, twist, now_ns)) {
    context_.logger->warn("team_drive of t {} ns is {:.2f} s old: not obeyed", command.t_ns,
                          kicking::seconds(now_ns) - kicking::seconds(command.t_ns));
    return;
  }
  if (!lockstep) drive_wheels(now_ns, obeyed_ == msg::DRIVE_TEAM);
}

/// Gives the wheels what the arbiter decides: `again`, or when another one is obeyed than before.
void OdometryNode::drive_wheels(std::int64_t now_ns, bool again) {
  std::optional<msg::WorldState> world;
  if (arbiter_.situation_matters(now_ns)) world = input_of_cycle(context_, *world_, now_ns);
  const auto situation = robot::drive_situation(world, now_ns, context_.settings.odometry.drive_timeout_s);
  const robot::ObeyedDrive obeyed = arbiter_.decide(now_ns, situation);
  const bool changed = obeyed.source != obeyed_;
  if (!again && !changed) return;
  obeyed_ = obeyed.source;
  wheels_->drive(obeyed.twist, context_.settings.run.lockstep ? now_ns : obeyed.t_ns);
  if (changed) say_who_drives(now_ns, situation);
}

void OdometryNode::say_who_drives(std::int64_t now_ns, const robot::DriveSituation& situation) {
  if (obeyed_ != msg::DRIVE_NOBODY) {
    context_.logger->debug("{} drives", obeyed_ == msg::DRIVE_TEAM ? "team_drive" : "kick_decision");
    return;
  }
  const auto silence_s = arbiter_.silence_s(now_ns, situation);
  if (!silence_s) {
    context_.logger->warn("nobody has written team_drive yet, whose turn it is: the base stops");
    return;
  }
  context_.logger->warn("no drive command for {:.2f} s: the base stops", *silence_s);
}

int odometry_main(int argc, char** argv) {
  return node_main(argc, argv, "odometry", [](NodeContext& context) {
    OdometryNode node{
        context, hal::open_wheels(context.settings.hal, {context.participant, context.robot_id(), context.robot.base})};
    run(context, node.node());
  });
}

}  // namespace trivela::nodes
