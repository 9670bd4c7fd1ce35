#pragma once

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "cli/launch/progress_bar.hpp"
#include "cli/launch/signals.hpp"
#include "cli/options/output.hpp"
#include "cli/options/play_options.hpp"
#include "cli/verbs.hpp"
#include "config/text/installation.hpp"
#include "experiment/run/arms.hpp"
#include "experiment/study/study.hpp"
#include "log/shards/study_results.hpp"

namespace trivela::cli {

/// The flags that all studies have.
struct StudyFlags {
  experiment::PlayPlan plan{
      .matches = 400, .possessions = 45, .jobs = std::max(1u, std::thread::hardware_concurrency())};
  World world;
  experiment::ArmBase base{config::shipped("default.toml").string(), {}, {}};
  std::uint32_t calibrations = 0;  ///< 0: the robot files as they are
  std::string blocked = "outside";
  std::string csv, svg;
  std::string results;            ///< file that keeps what was played; empty: none
  std::vector<std::string> with;  ///< results of other runs of this study, or of its shards
  bool json = false;

  experiment::StudyPlayed played(const sim::Scenario& scenario) const;

  /// Throws before anything is played: where an output cannot be written, and where a shard has no results file or is
  /// asked for a report.
  void require_writable() const;
};

/// Plays so many calibrations of the plan's seed into the plan, with a progress bar on a terminal. Throws
/// config::BadArgument where `base` names robot files, too, and where there are more calibrations than matches.
void draw_calibrations(const sim::Scenario& scenario, const experiment::ArmBase& base, std::uint32_t calibrations,
                       experiment::PlayPlan& plan);

/// The flags of the plan, the world, the calibrations, the results and the arms.
void add_play_options(CLI::App& verb, StudyFlags& flags);

/// --robot, --config, --set.
void add_arm_options(CLI::App& verb, experiment::ArmBase& base);

/// A study under way: its results, a line of progress, and Ctrl-C. It is made when everything else is known to be in
/// order, before the first thread.
class StudyRun {
 public:
  /// `arguments`: everything that the study's rows depend on but its flags of play, as text. Throws std::runtime_error
  /// where --results or --with cannot be used.
  StudyRun(const StudyFlags& flags, const std::string& name, const std::string& arguments);

  /// Plays what the results lack, keeps it, and gives what is known then. Throws Interrupted where somebody asks to
  /// stop.
  experiment::KnownPlay play(const std::vector<experiment::StudyWorld>& worlds, const experiment::PlayPlan& plan);

  /// Somebody asked to stop: keeps what was played, and says how to go on from there.
  ExitCode keep();

  /// Ends the line of progress.
  void finish() { bar_.end(); }

  /// Somebody asked to stop.
  struct Interrupted {};

 private:
  const StudyFlags& flags_;
  std::string name_;
  StopRequest stop_;  // before the results, which the first one must not leave behind
  log::StudyResults results_;
  ProgressBar bar_;
};

// Subcommands of `trivela study`.

AddVerb add_questions, add_study_tune, add_evaluate_policy, add_learn;

}  // namespace trivela::cli
