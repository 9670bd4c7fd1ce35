#pragma once

#include <cstdint>
#include <vector>

#include "idl/messages.hpp"
#include "kicking/policy/policy.hpp"

namespace trivela::experiment {

/// Who was in charge of a possession, and with which probability. The possession is the robot's own count.
struct Assignment {
  std::uint8_t robot_id = 1;
  std::uint8_t half = 1;
  std::uint32_t possession_id = 0;
  kicking::PolicyName policy{};
  double probability = 1.0;
  std::int64_t t_ns = 0;  ///< the first decision of it in play
};

/// The messages of a match that a log of it holds, in the order of their sequence numbers.
struct MatchRecord {
  std::vector<msg::Referee> referee;  ///< where its command changes
  std::vector<msg::KickDecision> decisions;
  std::vector<msg::KickOrder> orders;
  std::vector<msg::KickReceipt> receipts;
  std::vector<msg::KickOutcome> outcomes;
  std::vector<msg::KickerEstimate> estimates;
  std::vector<msg::KickTruth> kick_truths;
  std::vector<msg::PossessionTruth> possession_truths;
  std::vector<Assignment> assignments;
};

}  // namespace trivela::experiment
