#pragma once

#include <cstdint>
#include <vector>

#include "config/settings.hpp"
#include "kicking/policy/policy.hpp"

namespace trivela::robot {

/// A policy and the probability with which it is put in charge.
struct PolicyChance {
  kicking::PolicyName policy{};
  double probability = 1.0;
};

/// Who is in charge of a robot's possession: drawn from `random` where the settings name such policies, else the
/// robot's own policy, else the half's.
///
/// The draw is a pure function of (assignment_seed, robot, half, possession_id): the one 53-bit uniform number u of
/// Philox with that key and counter; policy i is in charge where u is between the sums of the probabilities before and
/// up to it. Whoever knows the four knows the policy, and no other number of the match is shifted by it.
class PolicyAssignment {
 public:
  PolicyAssignment(const config::KickDecision& settings, std::uint8_t robot_id);

  /// `half` counts from 1; where the settings name fewer, the last one goes on. possession_id 0: not counted.
  PolicyChance in_charge(std::uint8_t half, std::uint32_t possession_id) const;

  /// Every policy that may be put in charge.
  std::vector<kicking::PolicyName> candidates() const;

  bool random() const { return !random_.empty(); }

 private:
  std::vector<kicking::PolicyName> by_half_;
  std::vector<PolicyChance> random_;
  std::uint64_t seed_;
  std::uint8_t robot_id_;
};

}  // namespace trivela::robot
