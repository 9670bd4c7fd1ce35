// Every message of the wire contract: trivela::msg types with their bus::meta.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "idl/device.hpp"
#include "idl/kick.hpp"
#include "idl/robot.hpp"
#include "idl/sim.hpp"
#include "idl/team.hpp"

namespace trivela::msg {

/// What a message's number holds where there is none.
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace trivela::msg

namespace trivela::bus {

/// Calls f.operator()<T>() for each topic's type T in the order of the IDL.
template <class F>
constexpr void for_each_message(F&& f) {
  for_each_message_of_robot(f);
  for_each_message_of_kick(f);
  for_each_message_of_device(f);
  for_each_message_of_sim(f);
  for_each_message_of_team(f);
}

}  // namespace trivela::bus

namespace trivela::msg {

/// The name of the policy in charge; "invalid" for a number outside the enum, as label().
inline const char* policy_name(const KickDecision& decision) {
  // By its bits: to load a number outside the enum as its type is undefined.
  const bool own = std::bit_cast<std::uint32_t>(decision.policy) == static_cast<std::uint32_t>(POLICY_OWN);
  return own ? decision.own_policy : label(decision.policy);
}

/// Whether this receipt is the one with which a kick begins: a second one that accepts says that it may have been
/// fired.
inline bool begins_kick(const KickReceipt& receipt) { return receipt.accepted && receipt.refusal == REFUSAL_NONE; }

}  // namespace trivela::msg
