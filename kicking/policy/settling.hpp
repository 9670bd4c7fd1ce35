#pragma once

#include <cmath>

#include "kicking/geometry/time.hpp"
#include "kicking/policy/rule.hpp"

namespace trivela::kicking {

/// Has the robot been at rest for the test drives' settle_s? kApproaching: it moves; kSettling: not yet; kFire: yes.
inline Reason settle(const PolicyConfig& config, const PolicyInput& input,
                     std::optional<std::int64_t>& settling_since_t_ns) {
  const TestDriveConfig& rule = config.test_drive;
  const bool at_rest = std::hypot(input.twist.vx_mps, input.twist.vy_mps) <= rule.rest_speed_mps &&
                       std::abs(input.twist.omega_radps) <= rule.rest_turn_rate_radps;
  if (!at_rest) {
    settling_since_t_ns.reset();
    return Reason::kApproaching;
  }
  if (!settling_since_t_ns) settling_since_t_ns = input.t_ns;
  const double settled_s = seconds(input.t_ns - *settling_since_t_ns);
  return settled_s >= rule.settle_s ? Reason::kFire : Reason::kSettling;
}

}  // namespace trivela::kicking
