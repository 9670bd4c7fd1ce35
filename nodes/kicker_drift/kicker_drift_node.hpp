#pragma once

#include <cstdint>
#include <mutex>

#include "nodes/kicker_drift/kick_series.hpp"
#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// Decisions, receipts and outcomes of a robot in, KickerDrift out once its kicker has changed, by the watch that
/// `trivela drift` has (evaluator/drift/drift_watch.hpp). It looks on: nobody waits for it.
class KickerDriftNode {
 public:
  /// Throws std::runtime_error beside another one of the robot.
  explicit KickerDriftNode(NodeContext& context);
  bus::Node& node() { return node_; }

 private:
  template <class T>
  void listen();
  void judge();
  void say(const msg::KickerDrift& drift);

  NodeContext& context_;
  std::mutex mutex_;  // of what the reactions share
  KickSeries series_;
  bus::Node node_;
  bus::Output<msg::KickerDrift> drift_out_;
  msg::KickerDrift said_{};  // the last word
};

}  // namespace trivela::nodes
