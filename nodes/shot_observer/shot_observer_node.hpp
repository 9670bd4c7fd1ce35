#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "nodes/runtime/node_context.hpp"
#include "robot/observer/kick_learning.hpp"
#include "robot/observer/observer.hpp"

namespace trivela::nodes {

/// Decisions, receipts, the flight camera's frames and the referee's command in, KickOutcome out, and KickerEstimate
/// where the robot learns from its kicks.
class ShotObserverNode {
 public:
  explicit ShotObserverNode(NodeContext& context);
  bus::Node& node() { return node_; }

 private:
  void on_decision(const msg::KickDecision& decision);
  void on_receipt(const msg::KickReceipt& receipt);
  void on_frame(const msg::FlightFrame& frame);
  void publish(std::vector<msg::KickOutcome> settled, std::int64_t t_ns);
  void begin_learning();
  void say(const msg::KickerEstimate& estimate);
  void await_readers();
  void keep_refused_state();
  void keep(const msg::KickerEstimate& estimate);

  NodeContext& context_;
  std::mutex mutex_;  // the two reactions share the observer
  robot::Observer observer_;
  std::optional<robot::KickLearning> learning_;
  bus::Node node_;
  bus::Output<msg::KickOutcome> outcome_out_;
  std::optional<bus::Output<msg::KickerEstimate>> estimate_out_;
  std::optional<bus::Output<msg::StepDone>> step_done_;
  std::shared_ptr<bus::Mailbox<msg::Referee>> referee_;
  FirstCycle first_;
  std::uint64_t seq_ = 0;
  bool not_kept_said_ = false;
  bool keeps_ = true;  // estimates in the state file
};

}  // namespace trivela::nodes
