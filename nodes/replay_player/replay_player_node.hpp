#pragma once

#include "hal/replay/replay_topics.hpp"
#include "nodes/runtime/lockstep_barrier.hpp"
#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// Says again what cameras and referee said in a match log, cycle by cycle in lockstep, while the nodes' `replay`
/// devices give the log's wheel and kicker samples. The nodes decide anew; nothing of what they order happens.
class ReplayPlayerNode {
 public:
  /// Throws std::runtime_error for a log that was not recorded in lockstep: only there the streams share their cycles.
  explicit ReplayPlayerNode(NodeContext& context);

  /// Plays to the end of the log or until the stop is requested; prints "t_s total_s" lines for whoever shows progress.
  void run();

 private:
  void publish(const hal::ReplayedSample& sample);

  NodeContext& context_;
  hal::ReplayLog log_;
  hal::ReplayTopics topics_;
  bus::Writer<msg::VisionFrame> vision_;
  bus::Writer<msg::FlightFrame> flight_;
  bus::Writer<msg::Referee> referee_;
  LockstepBarrier barrier_;
};

}  // namespace trivela::nodes
