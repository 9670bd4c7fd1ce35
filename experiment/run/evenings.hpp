#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "experiment/run/arms.hpp"
#include "experiment/run/evening_arms.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

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
