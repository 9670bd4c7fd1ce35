#pragma once

#include <optional>

#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// The node's writer of StepDone in lockstep; nullopt otherwise, where nobody waits for it.
inline std::optional<bus::Output<msg::StepDone>> step_done_writer(const NodeContext& context, bus::Node& node) {
  if (!context.settings.run.lockstep) return std::nullopt;
  return node.writer<msg::StepDone>();
}

/// Tells the simulator, where it waits, that `node` has finished the cycle of t_ns with so many orders sent or handled
/// and kicks given to the device, and for which kind of kick the lever shall stand.
inline void step_done(const std::optional<bus::Output<msg::StepDone>>& writer, std::uint8_t robot_id,
                      msg::StepNode node, std::int64_t t_ns, std::uint32_t orders = 0, std::uint32_t fires = 0,
                      std::uint8_t lever_kind = 0) {
  if (!writer) return;
  msg::StepDone done{};
  done.robot_id = robot_id;
  done.node = node;
  done.t_ns = t_ns;
  done.orders = orders;
  done.fires = fires;
  done.lever_kind = lever_kind;
  writer->write(done);
}

}  // namespace trivela::nodes
