#include "cli/simulate/evenings.hpp"

#include <fmt/format.h>
#include "config/robot.hpp"
#include "sim/random.hpp"

namespace trivela::cli {

std::uint64_t evening_seed(std::uint64_t seed, std::uint32_t evening, std::uint32_t robot_id) {
  const auto words = sim::philox4x32({evening, robot_id, 0, 0x4556454e},
                                     {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  return (std::uint64_t{words[0]} << 32 | words[1]) >> 12;
}

// STUB until the evenings in process are there.
std::vector<Team> teams_of_evenings(const sim::Scenario&, const ArmBase&, const EveningPlan& plan) {
  std::vector<Team> teams;
  for (std::uint32_t k = 0; k < plan.evenings; ++k)
    teams.push_back({config::load_robot(fmt::format("{}/robots/calibrated_{}.toml", TRIVELA_CONFIG_DIR, k % 5 + 1))});
  return teams;
}

}  // namespace trivela::cli
