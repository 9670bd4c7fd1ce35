#include "sim/team.hpp"

#include <algorithm>

#include "kicking/random/draws.hpp"

namespace trivela::sim {

Kicker team_kicker(const Scenario& scenario, std::uint32_t robot) {
  Kicker kicker = scenario.kicker;
  const auto& ratios = scenario.team.speed_scale_ratios;
  if (!ratios.empty()) kicker.speed_scale_ratio *= ratios.at(robot - 1);
  return kicker;
}

Kicker match_kicker(const Scenario& scenario, std::uint32_t robot, std::uint64_t seed) {
  Kicker kicker = team_kicker(scenario, robot);
  const double drift =
      kicking::Draws{seed, 0}.normal(kicking::Role::kTeam, robot);  // opportunities count from 1: 0 is the match's own
  kicker.speed_scale_ratio *= std::max(0.5, 1.0 + kicker.drift_sd_ratio * drift);
  return kicker;
}

}  // namespace trivela::sim
