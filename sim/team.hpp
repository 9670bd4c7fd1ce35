#pragma once

#include <cstdint>

#include "sim/scenario.hpp"

namespace trivela::sim {

/// The kicker of one of our robots, counted from 1, on the day of its calibration: that of the scenario with the
/// robot's own speeds.
Kicker team_kicker(const Scenario& scenario, std::uint32_t robot);

/// The same in the match of that seed: its speeds have drifted by one factor 1 + N(0, drift_sd_ratio).
Kicker match_kicker(const Scenario& scenario, std::uint32_t robot, std::uint64_t seed);

}  // namespace trivela::sim
