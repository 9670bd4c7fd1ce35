#pragma once

#include <memory>
#include <optional>
#include <semaphore>
#include <string>

#include "hal/wheels.hpp"
#include "nodes/runtime/emulation_word.hpp"
#include "nodes/runtime/node_context.hpp"
#include "robot/odometry/wheel_odometry.hpp"

namespace trivela::nodes {

/// Owns the base: wheel samples in, Odometry out; DriveCommand in, set-points to the wheels. Without commands for
/// odometry.drive_timeout_s the base stops, whether or not its wheels say anything; a command that is older is none.
class OdometryNode {
 public:
  OdometryNode(NodeContext& context, std::unique_ptr<hal::Wheels> wheels);
  bus::Node& node() { return node_; }

 private:
  std::optional<hal::WheelSample> next_sample(std::chrono::nanoseconds timeout);
  void say_status(bool heard);
  void on_wheels(const hal::WheelSample& sample);
  void stop_without_commands();
  void on_drive(const msg::DriveCommand& command);
  msg::DriveSource obeyed();

  NodeContext& context_;
  std::unique_ptr<hal::Wheels> wheels_;
  robot::WheelOdometry odometry_;
  bus::Node node_;
  bus::Output<msg::Odometry> odometry_out_;
  EmulationWord emulation_;
  std::optional<bus::Output<msg::StepDone>> step_done_;
  FirstCycle first_;
  std::counting_semaphore<> cycle_over_{1};
  std::uint64_t seq_ = 0;
  std::string status_said_;
  std::mutex drive_mutex_;  // device thread and drive reaction
  std::int64_t commanded_t_ns_ = 0;
  bool driving_ = false;
};

}  // namespace trivela::nodes
