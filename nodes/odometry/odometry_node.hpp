#pragma once

#include <memory>
#include <optional>
#include <semaphore>
#include <string>

#include "hal/wheels.hpp"
#include "nodes/runtime/node_context.hpp"
#include "nodes/runtime/simulated_device_notice.hpp"
#include "robot/odometry/drive_arbiter.hpp"
#include "robot/odometry/wheel_odometry.hpp"

namespace trivela::nodes {

/// Owns the base: wheel samples in, Odometry out; DriveCommand and TeamDrive in, set-points to the wheels. Whose
/// command they get is the DriveArbiter's; without one the base stops, whether or not its wheels say anything.
class OdometryNode {
 public:
  OdometryNode(NodeContext& context, std::unique_ptr<hal::Wheels> wheels);
  bus::Node& node() { return node_; }

 private:
  std::optional<hal::WheelSample> next_sample(std::chrono::nanoseconds timeout);
  void say_status(bool received);
  void on_wheels(const hal::WheelSample& sample);
  void stop_without_commands();
  void on_drive(const msg::DriveCommand& command);
  void on_team_drive(const msg::TeamDrive& command);
  void drive_wheels(std::int64_t now_ns, bool again);
  void say_who_drives(std::int64_t now_ns, const robot::DriveSituation& situation);
  msg::DriveSource obeyed();

  NodeContext& context_;
  std::unique_ptr<hal::Wheels> wheels_;
  robot::WheelOdometry odometry_;
  bus::Node node_;
  bus::Output<msg::Odometry> odometry_out_;
  SimulatedDeviceNotice emulation_;
  std::optional<bus::Output<msg::StepDone>> step_done_;
  FirstCycle first_;
  std::counting_semaphore<> cycle_over_{1};
  std::uint64_t seq_ = 0;
  std::string status_said_;
  std::shared_ptr<bus::Mailbox<msg::WorldState>> world_;
  std::mutex drive_mutex_;  // device thread and drive reactions
  robot::DriveArbiter arbiter_;
  msg::DriveSource obeyed_ = msg::DRIVE_NOBODY;
};

}  // namespace trivela::nodes
