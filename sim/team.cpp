#include "sim/team.hpp"

#include <algorithm>

#include "sim/random.hpp"

namespace trivela::sim {

Kicker team_kicker(const Scenario& scenario, std::uint32_t robot) {
  Kicker kicker = scenario.kicker;
  const auto& ratios = scenario.team.speed_scale_ratios;
  if (!ratios.empty()) kicker.speed_scale_ratio *= ratios.at(robot - 1);
  return kicker;
}

Kicker match_kicker(const Scenario& scenario, std::uint32_t robot, std::uint64_t seed) {
  Kicker kicker = team_kicker(scenario, robot);
  const double drift = Draws{seed, 0}.normal(Role::kTeam, robot);  // opportunities count from 1: 0 is the match's own
  kicker.speed_scale_ratio *= std::max(0.5, 1.0 + kicker.drift_sd_ratio * drift);
  return kicker;
}

}  // namespace trivela::sim
