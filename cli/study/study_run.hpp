#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/launch/progress_bar.hpp"
#include "cli/launch/stop_request.hpp"
#include "cli/study/study.hpp"
#include "cli/verbs.hpp"
#include "experiment/study/study.hpp"
#include "log/shards/study_results.hpp"

namespace trivela::cli {

/// A study under way: its results, a line of progress, and Ctrl-C. It is made when everything else is known to be in
/// order, before the first thread.
class StudyRun {
 public:
  /// `arguments`: everything that the study's rows depend on but its flags of play, as text. Throws std::runtime_error
  /// where --results or --with cannot be used.
  StudyRun(const StudyFlags& flags, const std::string& name, const std::string& arguments);

  /// Plays what the results lack and gives what is known then. Throws Interrupted where somebody asks to stop.
  experiment::KnownPlay play(const std::vector<experiment::StudyWorld>& worlds, const experiment::PlayPlan& plan);

  /// Somebody asked to stop: keeps what was played, and says how to go on from there.
  ExitCode keep();

  /// What was asked for is there.
  void finish();

  /// Somebody asked to stop.
  struct Interrupted {};

 private:
  const StudyFlags& flags_;
  std::string name_;
  StopRequest stop_;  // before the results, which the first one must not leave behind
  log::StudyResults results_;
  ProgressBar bar_;
};

/// Plays the study that `make` makes of the scenario, and gives its report: printed as text or JSON, and the files that
/// were asked for last, so that a full disk takes no more than the file. A shard's part has no report.
ExitCode run_study(StudyFlags flags, const std::function<experiment::Study(const sim::Scenario&)>& make);

}  // namespace trivela::cli
