#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "bus/reader.hpp"
#include "bus/stop.hpp"
#include "idl/messages.hpp"
#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// The node's writer of StepDone in lockstep; nullopt otherwise, where nobody waits for it.
inline std::optional<bus::Output<msg::StepDone>> step_done_writer(const NodeContext& context, bus::Node& node) {
  if (!context.settings.run.lockstep) return std::nullopt;
  return node.writer<msg::StepDone>();
}

/// Tells the simulator, where it waits, that `node` has finished the cycle of t_ns. `orders`: sent or handled so far.
/// `fires`: kicks given to the device so far. `lever_kind`: kind of kick for which the lever shall stand.
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

/// Waits until every node has finished a cycle and the driver has answered every order that was sent.
class LockstepBarrier {
 public:
  LockstepBarrier(const bus::Participant& participant, std::uint8_t robot_id)
      : reader_(participant), robot_id_(robot_id) {}

  /// From now on the scan recorder must have recorded the scan of t_ns, too.
  void expect_scan(std::int64_t t_ns) { scan_t_ns_ = t_ns; }

  /// False: the stop was requested. Throws std::runtime_error naming the nodes that have not finished the cycle of t_ns
  /// when nothing came for 20 s.
  bool wait_for(std::int64_t t_ns, const bus::Stop& stop);

  /// Kicks that the driver has given to its device so far.
  std::uint32_t fires() const { return nodes_[msg::STEP_KICKER_DRIVER].fires; }

  /// Kind of kick for which the decision wants the lever to stand.
  std::uint8_t lever_kind() const { return nodes_[msg::STEP_KICK_DECISION].lever_kind; }

 private:
  bool finished(std::int64_t t_ns) const;
  /// What a node must have reported for the cycle of t_ns to be over.
  std::int64_t due(std::size_t node, std::int64_t t_ns) const {
    return node == msg::STEP_SCAN_RECORDER ? scan_t_ns_ : t_ns;
  }

  struct Progress {
    std::int64_t t_ns = -1;
    std::uint32_t orders = 0;
    std::uint32_t fires = 0;
    std::uint8_t lever_kind = 0;
  };
  bus::Reader<msg::StepDone> reader_;
  std::uint8_t robot_id_;
  static constexpr std::int64_t kNothing = -1;
  std::int64_t scan_t_ns_ = kNothing;
  std::array<Progress, 6> nodes_{};
};

}  // namespace trivela::nodes
