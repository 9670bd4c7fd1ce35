#pragma once

#include <array>
#include <chrono>
#include <optional>

#include "kicking/policy/policy.hpp"
#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// WorldState in, with the kicker's status and what was seen of the last kick; DriveCommand out every cycle,
/// KickDecision every cycle with the ball, KickOrder on a fire. Of stopped and moving the one that is not in charge
/// judges every cycle as well, with a memory of its own, and rides along as a shadow.
class KickDecisionNode {
 public:
  explicit KickDecisionNode(NodeContext& context);
  bus::Node& node() { return node_; }

 private:
  static constexpr std::array kShadows{kicking::PolicyName::kStopped, kicking::PolicyName::kMoving};

  void on_world(const msg::WorldState& world);
  kicking::PolicyName in_charge(std::uint8_t half) const;
  std::optional<kicking::SeenKick> last_kick(const msg::WorldState& world, const msg::KickerStatus* kicker);
  std::int64_t send_order(const msg::WorldState& world, const kicking::Judgement& judgement);
  void drive(const msg::WorldState& world, const kicking::Judgement& judgement);
  void stay_alive();

  NodeContext& context_;
  bus::Node node_;
  bus::Output<msg::KickDecision> decision_out_;
  bus::Output<msg::KickOrder> order_out_;
  bus::Output<msg::DriveCommand> drive_out_;
  std::optional<bus::Output<msg::StepDone>> step_done_;
  std::shared_ptr<bus::Mailbox<msg::KickerStatus>> kicker_;
  std::shared_ptr<bus::Mailbox<msg::KickOutcome>> outcome_;
  FirstCycle first_;
  std::array<kicking::PolicyMemory, kicking::kPolicyCount> memory_{};
  msg::KickOrder last_order_{};
  std::uint32_t last_order_possession_id_ = 0;
  std::int64_t kick_id_base_;
  std::uint32_t orders_ = 0;
  std::uint64_t decisions_ = 0;
  std::uint64_t drives_ = 0;
  std::chrono::steady_clock::time_point asserted_{};
};

}  // namespace trivela::nodes
