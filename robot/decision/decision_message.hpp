#pragma once

#include "idl/messages.hpp"
#include "kicking/policy/policy.hpp"

namespace trivela::robot {

/// The wire's enums and the algorithm's are the same lists; these convert by position.
msg::Policy to_wire(kicking::PolicyName policy);
msg::DecisionReason to_wire(kicking::Reason reason);

/// What the policies are told of a cycle. `state_age_s` is the age of the older of the two messages against the newer.
kicking::PolicyInput policy_input(const msg::WorldState& world, const msg::KickerStatus* kicker);

/// The record of a decision; robot_id, seq and kick_id are the node's.
msg::KickDecision decision_message(const msg::WorldState& world, const msg::KickerStatus* kicker,
                                   kicking::PolicyName policy, const kicking::PolicyOutput& output);

msg::ShadowDecision shadow_message(kicking::PolicyName policy, const kicking::PolicyOutput& output);

}  // namespace trivela::robot
