#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/launch/progress_bar.hpp"
#include "cli/launch/stop_request.hpp"
#include "cli/study/study.hpp"
#include "cli/verbs.hpp"
#include "log/shards/study_results.hpp"

namespace trivela::cli {

/// A study under way: its results, a line of progress, and Ctrl-C. It is made when everything else is known to be in
/// order, before the first thread.
class StudyRun {
 public:
  /// `arguments`: everything that the study's rows depend on but its flags of play, as text. `arms`: that it will play
  /// in all; 0: nobody knows. Throws std::runtime_error where --results or --with cannot be used.
  StudyRun(const Study& study, const std::string& name, const std::string& arguments, std::size_t arms);

  /// Plays what the results lack and gives what is known then. Throws Interrupted where somebody asks to stop.
  experiment::KnownPlay play_known(const sim::Scenario& scenario, const std::vector<experiment::Arm>& arms,
                                   const experiment::PlayPlan& plan, const std::string& what);

  /// The arms of play_known().
  std::vector<experiment::ArmTally> play(const sim::Scenario& scenario, const std::vector<experiment::Arm>& arms,
                                         const std::string& what) {
    return play_known(scenario, arms, study_.plan, what).arms;
  }

  /// `play_all`, then `report` unless this is a shard. Stopped: what was played is kept, and said where.
  ExitCode run(const std::function<void()>& play_all, const std::function<void()>& report);

  /// Keeps what was played, and says how to go on from there.
  void keep();

  void finish() { results_.finish(); }

  /// Somebody asked to stop.
  struct Interrupted {};

 private:
  const Study& study_;
  std::string name_;
  StopRequest stop_;  // before the results, which the first one must not leave behind
  log::StudyResults results_;
  ProgressBar bar_;
  bool knows_all_;         // how many matches of arms it will play
  double expected_ = 0.0;  // of those that are not known; where nobody knows: of this step
  double played_ = 0.0;
};

}  // namespace trivela::cli
