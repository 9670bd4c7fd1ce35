#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "experiment/run/arms.hpp"
#include "experiment/run/evening_arms.hpp"
#include "kicking/random/draws.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

inline constexpr std::uint64_t kEveningSeeds = 1'000'001;  ///< 0 to 1e6, as `trivela calibrate run --seed` takes them

/// The seed of one robot's evening of calibration, a pure function of the experiment's seed.
inline std::uint64_t evening_seed(std::uint64_t seed, std::uint32_t evening, std::uint32_t robot_id) {
  const auto words = kicking::philox4x32({evening, robot_id, 0, 0x4556454e},
                                         {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  return (std::uint64_t{words[0]} << 32 | words[1]) % kEveningSeeds;
}

/// Which evenings of calibration an experiment plays before its matches.
struct EveningPlan {
  std::uint32_t evenings = 0;  ///< 0: none, robots are those of the files
  std::uint64_t seed = 1;      ///< of the experiment
  unsigned jobs = 1;           ///< threads
};

/// The teams that the evenings leave behind. The same for any number of jobs. `progress`: evenings of robots that were
/// played, of how many; called by one thread at a time.
std::vector<Team> teams_of_evenings(
    const sim::Scenario& world, const EveningPlan& plan,
    const std::function<void(std::size_t done, std::size_t all)>& progress = [](auto, auto) {});

}  // namespace trivela::experiment
