#pragma once

#include <atomic>
#include <chrono>
#include <optional>

#include "nodes/runtime/node_context.hpp"
#include "robot/decision/decider.hpp"
#include "robot/watch/decision_watch.hpp"

namespace trivela::nodes {

enum class DecisionNode { kFirst, kSecond };

/// WorldState in, with the kicker's status and what was seen of the last kick; DriveCommand out every cycle,
/// KickDecision every cycle with the ball, KickOrder on a fire. What it decides is the Decider's. The second one of a
/// robot decides alike and says nothing while it hears the first.
class KickDecisionNode {
 public:
  /// Throws std::runtime_error where the settings put the oracle in charge, which needs the simulator's true state.
  /// `which`: the robot's only or first one, or the second, which needs kick_decision.standby: std::runtime_error too.
  explicit KickDecisionNode(NodeContext& context, DecisionNode which = DecisionNode::kFirst);
  bus::Node& node() { return node_; }

 private:
  void on_world(const msg::WorldState& world);
  void learn(std::int64_t t_ns);
  bool in_charge();
  void say(const msg::WorldState& world, const msg::KickerStatus* kicker, const robot::CycleDecision& decision);
  double age_s(const msg::WorldState& world) const;
  std::optional<msg::KickOutcome> outcome(const msg::WorldState& world, const msg::KickerStatus* kicker);
  void drive(const msg::WorldState& world, const kicking::PolicyOutput& output);
  void stay_alive();
  bus::ReaderOptions count_observers();
  void say_unobserved();
  void say_slow(kicking::PolicyName policy, double took_s);

  NodeContext& context_;
  DecisionNode which_;
  robot::Decider decider_;
  bus::Node node_;
  bus::Output<msg::KickDecision> decision_out_;
  bus::Output<msg::KickOrder> order_out_;
  bus::Output<msg::DriveCommand> drive_out_;
  std::optional<bus::Output<msg::StepDone>> step_done_;
  std::shared_ptr<bus::Mailbox<msg::KickerStatus>> kicker_;
  std::atomic<std::uint32_t> observers_{0};  // writers of kick_outcome, of which none is needed
  bool unobserved_said_ = false;
  bool slow_said_ = false;
  std::shared_ptr<bus::Mailbox<msg::KickOutcome>> outcome_;
  std::shared_ptr<bus::Mailbox<msg::Referee>> referee_;  // looked up where the rules know set pieces
  std::shared_ptr<bus::Mailbox<msg::KickerEstimate>> estimate_;
  FirstCycle first_;
  robot::StandbyWatch first_node_;  // of the second node
  bool waits_ = true;               // for the first one to fall silent
  std::uint64_t drives_ = 0;
  std::chrono::steady_clock::time_point asserted_{};
};

}  // namespace trivela::nodes
