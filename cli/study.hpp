#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cli/output.hpp"
#include "cli/world.hpp"
#include "evaluator/log/shard.hpp"
#include "evaluator/report/json_values.hpp"
#include "experiment/run/arms.hpp"
#include "experiment/run/evenings.hpp"
#include "experiment/run/kept_play.hpp"

namespace trivela::cli {

/// What the verbs have in common that play many matches of several arms and report on them.
struct Study {
  experiment::PlayPlan plan{.jobs = std::max(1u, std::thread::hardware_concurrency())};
  World world;
  std::uint32_t calibrations = 0;  ///< evenings; 0: the robot files as they are
  std::string csv, svg;
  std::string tallies;  ///< book of what was played; empty: none
  std::optional<evaluator::log::Shard> shard;
  bool json = false;

  /// Name of the scenario's file and what was changed of it, for the report.
  std::string scenario_name() const;

  /// Plays the evenings of calibration of the plan's seed into the plan, before its matches.
  void draw_evenings(const sim::Scenario& scenario, const experiment::ArmBase& base);
};

/// The teams of the evenings of calibration, played with a progress bar on a terminal, for an experiment of so many
/// matches. Throws UsageError where `base` names robot files, too, and where there are more evenings than matches.
std::vector<experiment::Team> draw_evenings(const sim::Scenario& scenario, const experiment::ArmBase& base,
                                            const experiment::EveningPlan& plan, std::uint32_t matches);

/// Says on standard error where an arm has fewer robot files than the scenario's team has robots.
void warn_of_shared_robots(const sim::Scenario& scenario, const std::vector<experiment::Arm>& arms);

/// --matches, --possessions, --seed, --jobs, --scenario, --world, --calibrations, --tallies, --shard.
void add_play_options(CLI::App& verb, Study& study);

/// --calibrations alone.
void add_calibrations_option(CLI::App& verb, std::uint32_t& calibrations);

/// Those of add_play_options(), and --csv, --svg, --json.
void add_study_options(CLI::App& verb, Study& study);

/// --robot, --config, --set.
void add_arm_options(CLI::App& verb, experiment::ArmBase& base);

/// Throws, before anything is played, where --csv or --svg cannot be written or are the same file, or a shard has no
/// place for what it plays or is asked for a report.
void require_writable(const Study& study);

/// Prints the report as text or JSON, and writes its files that are asked for: last, so that a full disk takes no more
/// than the file.
template <typename Report>
void give(const Study& study, const Report& report) {
  study.json ? fmt::print("{}", evaluator::json_text(to_json(report))) : say(to_text(report));
  std::fflush(stdout);
  if (!study.csv.empty()) write_file(study.csv, to_csv(report));
  if (!study.svg.empty()) write_file(study.svg, to_svg(report));
}

}  // namespace trivela::cli
