#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "cli/factorial/play.hpp"
#include "cli/say.hpp"
#include "cli/simulate/arms.hpp"
#include "cli/simulate/evenings.hpp"
#include "cli/write_file.hpp"
#include "evaluator/report/json_values.hpp"

namespace trivela::cli {

/// What --seed may be.
inline const CLI::Range kSeeds{std::uint64_t{0}, std::uint64_t{9'000'000'000'000'000}};

/// What the verbs have in common that play many matches of several arms and report on them.
struct Study {
  PlayPlan plan{.jobs = std::max(1u, std::thread::hardware_concurrency())};
  std::string scenario = TRIVELA_CONFIG_DIR "/scenarios/default.toml";
  std::uint32_t calibrations = 0;  ///< evenings; 0: the robot files as they are
  std::string csv, svg;
  bool json = false;

  /// Name of the scenario's file, for the report.
  std::string scenario_name() const;

  /// Plays the evenings of calibration of the plan's seed into the plan, before its matches.
  void draw_evenings(const sim::Scenario& world, const ArmBase& base);
};

/// --matches, --possessions, --seed, --jobs, --scenario, --calibrations.
void add_play_options(CLI::App& verb, Study& study);

/// --calibrations alone.
void add_calibrations_option(CLI::App& verb, std::uint32_t& calibrations);

/// Those of add_play_options(), and --csv, --svg, --json.
void add_study_options(CLI::App& verb, Study& study);

/// --robot, --config, --set.
void add_arm_options(CLI::App& verb, ArmBase& base);

/// Plays the arms with a progress bar that says what they are played for.
std::vector<ArmTally> play_with_bar(const sim::Scenario& scenario, const std::vector<nodes::Arm>& arms,
                                    const PlayPlan& plan, const std::string& what);

/// Writes the report's files that are asked for, and prints it as text or JSON.
template <typename Report>
void give(const Study& study, const Report& report) {
  if (!study.csv.empty()) write_file(study.csv, to_csv(report));
  if (!study.svg.empty()) write_file(study.svg, to_svg(report));
  study.json ? fmt::print("{}", evaluator::json_text(to_json(report))) : say(to_text(report));
}

}  // namespace trivela::cli
