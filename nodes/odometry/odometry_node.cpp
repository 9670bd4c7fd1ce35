#include "nodes/odometry/odometry_node.hpp"

#include <limits>

#include "nodes/runtime/step_done.hpp"

namespace trivela::nodes {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

msg::Odometry message(const hal::WheelSample& sample, const OdometryEstimate& estimate) {
  const auto wheel = [&](int i) {
    return i < sample.wheel_count ? sample.wheel_radps[static_cast<std::size_t>(i)] : kNone;
  };
  msg::Odometry out{};
  out.t_ns = sample.t_ns;
  out.wheel_0_radps = wheel(0);
  out.wheel_1_radps = wheel(1);
  out.wheel_2_radps = wheel(2);
  out.wheel_3_radps = wheel(3);
  out.gyro_radps = sample.gyro_radps.value_or(kNone);
  out.vx_mps = estimate.twist.vx_mps;
  out.vy_mps = estimate.twist.vy_mps;
  out.omega_radps = estimate.twist.omega_radps;
  out.x_m = estimate.pose.x_m;
  out.y_m = estimate.pose.y_m;
  out.heading_rad = kicking::wrap_angle(estimate.pose.heading_rad);
  out.var_v_m2ps2 = estimate.var_v_m2ps2;
  out.var_omega_rad2ps2 = estimate.var_omega_rad2ps2;
  out.var_position_m2 = estimate.var_position_m2;
  out.var_heading_rad2 = estimate.var_heading_rad2;
  return out;
}

}  // namespace

OdometryNode::OdometryNode(NodeContext& context, std::unique_ptr<hal::Wheels> wheels)
    : context_(context),
      wheels_(std::move(wheels)),
      odometry_(context.robot.base, context.settings.odometry),
      node_(context.participant, "odometry", context.robot_id()),
      odometry_out_(node_.writer<msg::Odometry>()),
      step_done_(step_done_writer(context, node_)),
      first_(context.settings.run.lockstep) {
  refuse_twin(context_, odometry_out_, "odometry");
  node_.on_device(
      "wheels", [this](std::chrono::nanoseconds timeout) { return next_sample(timeout); },
      [this](const hal::WheelSample& sample) { on_wheels(sample); }, bus::writes<msg::Odometry, msg::SimDrive>());
  node_.on<msg::DriveCommand>([this](const msg::DriveCommand& command) { on_drive(command); },
                              bus::writes<msg::SimDrive, msg::StepDone>());
}

/// In lockstep the next sample waits for the drive command of the last one: a replayed log knows no other pace.
std::optional<hal::WheelSample> OdometryNode::next_sample(std::chrono::nanoseconds timeout) {
  if (wheels_->ended()) {
    context_.idle(timeout);
    return std::nullopt;
  }
  if (context_.settings.run.lockstep && !cycle_over_.try_acquire_for(timeout)) return std::nullopt;
  auto sample = wheels_->read(timeout);
  if (!sample && context_.settings.run.lockstep) cycle_over_.release();
  return sample;
}

void OdometryNode::on_wheels(const hal::WheelSample& sample) {
  first_.once([this] {
    expect_device(*wheels_);
    expect_readers(odometry_out_, 2);  // world_state, recorder
  });
  const std::span<const double> speeds{sample.wheel_radps.data(), static_cast<std::size_t>(sample.wheel_count)};
  const auto estimate = odometry_.update(sample.t_ns, speeds, sample.gyro_radps);
  if (!estimate) {
    context_.logger->warn("wheel sample of t {} ns is unusable: not finite, too few wheels, or not newer", sample.t_ns);
    return;
  }
  msg::Odometry out = message(sample, *estimate);
  out.robot_id = context_.robot_id();
  out.seq = ++seq_;
  odometry_out_.write(out);
  stop_without_commands(sample.t_ns);
}

/// A robot that nobody drives any more stands still. In lockstep the next command is waited for instead.
void OdometryNode::stop_without_commands(std::int64_t t_ns) {
  if (context_.settings.run.lockstep) return;
  const std::lock_guard lock{drive_mutex_};
  const double silence_s = std::chrono::duration<double>{std::chrono::steady_clock::now() - commanded_}.count();
  if (!driving_ || silence_s <= context_.settings.odometry.drive_timeout_s) return;
  driving_ = false;
  wheels_->drive({}, t_ns);
  context_.logger->warn("no drive command for {:.2f} s: the base stops", silence_s);
}

void OdometryNode::on_drive(const msg::DriveCommand& command) {
  {
    const std::lock_guard lock{drive_mutex_};
    commanded_ = std::chrono::steady_clock::now();
    driving_ = true;
    wheels_->drive({command.vx_mps, command.vy_mps, command.omega_radps}, command.t_ns);
  }
  step_done(step_done_, context_.robot_id(), msg::STEP_ODOMETRY, command.t_ns);
  if (context_.settings.run.lockstep) cycle_over_.release();
}

}  // namespace trivela::nodes
