#pragma once

#include "bus/node.hpp"
#include "config/settings.hpp"

namespace trivela::cli {

/// Which devices of a robot are free. A claim is a writer of what the device's node would write: a node that runs is
/// seen by its own, and one that starts meanwhile refuses as beside a second of its kind.
class DeviceLocks {
 public:
  DeviceLocks(const bus::Participant& participant, std::uint8_t robot_id);

  bool odometry_runs() const { return odometry_runs_; }
  bool kicker_driver_runs() const { return kicker_driver_runs_; }
  /// By refbox or a simulator.
  bool referee_is_written() const { return referee_is_written_; }

  // Each throws std::runtime_error naming the node that has the device.
  void require_wheels() const;
  void require_kicker() const;

 private:
  std::uint8_t robot_id_;
  bus::Node odometry_node_;
  bus::Node driver_node_;
  bus::Node referee_node_;
  bus::Output<msg::Odometry> odometry_;
  bus::Output<msg::KickReceipt> receipts_;
  bus::Output<msg::Referee> referee_;
  bool odometry_runs_;
  bool kicker_driver_runs_;
  bool referee_is_written_;
};

}  // namespace trivela::cli
