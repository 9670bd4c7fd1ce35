#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/play/play_match.hpp"
#include "experiment/run/evening_arms.hpp"

namespace trivela::experiment {

/// What `trivela simulate` plays.
struct ExperimentPlan {
  sim::Scenario scenario;
  std::string scenario_name;
  std::vector<Arm> arms;
  std::uint64_t seed = 1;
  std::uint32_t matches = 1;
  std::uint32_t possessions = 60;
  PlayOptions options;
  std::vector<Team> evenings;  ///< of calibration; match m is played with evening m mod their number; empty: none

  /// Everything that the rows depend on, as text.
  std::string arguments() const;
};

/// Throws UsageError or std::runtime_error in a sentence that names the arm, where a match of the plan cannot be
/// played.
void check_playable(const ExperimentPlan& plan);

/// Checks the plan, so that one that is refused leaves no log. Plays what is missing in the log `out` with `jobs`
/// threads, and prints what each arm did. The rows do not depend on `jobs`, nor on how often the run was stopped.
/// Returns the exit code.
int run_experiment(const ExperimentPlan& plan, unsigned jobs, const std::string& out);

}  // namespace trivela::experiment
