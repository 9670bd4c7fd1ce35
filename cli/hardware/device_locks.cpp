#include "cli/hardware/device_locks.hpp"

#include <fmt/core.h>

#include <stdexcept>

#include "nodes/runtime/node_context.hpp"

namespace trivela::cli {
namespace {

void refuse_beside(const char* node, std::uint8_t robot_id) {
  throw std::runtime_error{fmt::format(
      "{} of robot {} runs and has the device, or another trivela hardware: stop it first", node, robot_id)};
}

}  // namespace

DeviceLocks::DeviceLocks(const bus::Participant& participant, std::uint8_t robot_id)
    : robot_id_(robot_id),
      odometry_node_(participant, "odometry", robot_id),
      driver_node_(participant, "kicker_driver", robot_id),
      referee_node_(participant, "refbox", robot_id),
      odometry_(odometry_node_.writer<msg::Odometry>()),
      receipts_(driver_node_.writer<msg::KickReceipt>()),
      referee_(referee_node_.writer<msg::Referee>(nodes::referee_of(robot_id))),
      odometry_runs_(odometry_.other_writer_exists()),
      kicker_driver_runs_(receipts_.other_writer_exists()),
      referee_is_written_(referee_.other_writer_exists()) {}

void DeviceLocks::require_wheels() const {
  if (odometry_runs_) refuse_beside("odometry", robot_id_);
}

void DeviceLocks::require_kicker() const {
  if (kicker_driver_runs_) refuse_beside("kicker_driver", robot_id_);
}

}  // namespace trivela::cli
