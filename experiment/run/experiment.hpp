#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiment/play/play_match.hpp"
#include "experiment/run/arms.hpp"

namespace trivela::experiment {

/// What `trivela simulate` plays.
struct ExperimentPlan : PlayPlan {
  sim::Scenario scenario{};
  std::string scenario_name{};
  std::vector<Arm> arms{};
  PlayOptions options{};

  /// Everything that the rows of a match depend on, as text.
  std::string arguments() const;
};

/// Throws config::BadArgument or std::runtime_error in a sentence that names the arm, where a match of the plan cannot
/// be played.
void check_playable(const ExperimentPlan& plan);

struct ArmMatch;

/// Who looks on while an experiment is played.
struct ExperimentWatch {
  std::function<void(std::int64_t matches)> found;                                   ///< in the log already
  std::function<void(double done, double total, const std::string& what)> progress;  ///< after each match
  std::function<bool()> stop;  ///< asked as often: shall no further match begin?
  std::function<void(std::uint32_t match_id, const std::vector<ArmMatch>& arms)>
      played{};  ///< each match; may be empty
};

/// What a run of an experiment did.
struct ExperimentRun {
  std::int64_t matches = 0;         ///< played
  std::int64_t in_log = 0;          ///< with those of earlier runs
  double wall_s = 0.0;              ///< for them
  std::vector<double> processor_s;  ///< of each arm
  bool complete = false;            ///< nobody stopped it
};

/// Plays what is missing of a playable plan in the log `out`. The rows do not depend on the number of threads, nor on
/// how often the run was stopped.
ExperimentRun run_experiment(const ExperimentPlan& plan, const std::string& out, const ExperimentWatch& watch);

/// What each arm did in the complete experiment, or shard, in the log `out`, and how fast the run was.
std::string to_text(const ExperimentPlan& plan, const ExperimentRun& run, const std::string& out);

}  // namespace trivela::experiment
