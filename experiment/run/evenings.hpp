#pragma once

#include <cstdint>
#include <vector>

#include "experiment/run/arms.hpp"
#include "experiment/run/evening_arms.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

/// Which evenings of calibration an experiment plays before its matches.
struct EveningPlan {
  std::uint32_t evenings = 0;  ///< 0: none, robots are those of the files
  std::uint32_t matches = 1;   ///< of the experiment
  std::uint64_t seed = 1;      ///< of the experiment
  unsigned jobs = 1;           ///< threads
};

/// The teams that the evenings leave behind. The same for any number of jobs. A progress bar on a terminal. Throws
/// UsageError where `base` names robot files, too, and where there are more evenings than matches.
std::vector<Team> teams_of_evenings(const sim::Scenario& world, const ArmBase& base, const EveningPlan& plan);

}  // namespace trivela::experiment
