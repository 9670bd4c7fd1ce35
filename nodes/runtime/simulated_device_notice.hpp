#pragma once

#include <cstdint>
#include <set>

#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// "This device is a program", said once for each part and kept for the recorder that comes later: a session in which
/// it is heard is simulated. For one thread.
class SimulatedDeviceNotice {
 public:
  SimulatedDeviceNotice(const NodeContext& context, bus::Node& node)
      : robot_id_(context.robot_id()), out_(node.writer<msg::DeviceEmulated>()) {}

  /// Of a sample of `part` at t_ns; within a reaction that declares DeviceEmulated.
  void see(msg::DevicePart part, bool emulated, std::int64_t t_ns) {
    if (!emulated || !said_.insert(part).second) return;
    msg::DeviceEmulated word{};
    word.robot_id = robot_id_;
    word.part = part;
    word.seq = said_.size();
    word.t_ns = t_ns;
    out_.write(word);
  }

 private:
  std::uint8_t robot_id_;
  bus::Output<msg::DeviceEmulated> out_;
  std::set<msg::DevicePart> said_;
};

}  // namespace trivela::nodes
