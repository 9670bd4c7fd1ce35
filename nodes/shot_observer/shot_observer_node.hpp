#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "nodes/runtime/node_context.hpp"
#include "robot/observer/observer.hpp"

namespace trivela::nodes {

/// Receipts, the flight camera's frames and the referee's word in, KickOutcome out.
class ShotObserverNode {
 public:
  explicit ShotObserverNode(NodeContext& context);
  bus::Node& node() { return node_; }

 private:
  void on_receipt(const msg::KickReceipt& receipt);
  void on_frame(const msg::FlightFrame& frame);
  void publish(std::vector<msg::KickOutcome> settled);

  NodeContext& context_;
  std::mutex mutex_;  // the two reactions share the observer
  robot::Observer observer_;
  bus::Node node_;
  bus::Output<msg::KickOutcome> outcome_out_;
  std::optional<bus::Output<msg::StepDone>> step_done_;
  std::shared_ptr<bus::Mailbox<msg::Referee>> referee_;
  FirstCycle first_;
  std::uint64_t seq_ = 0;
};

}  // namespace trivela::nodes
