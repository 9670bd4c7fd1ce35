#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/arms.hpp"
#include "config/settings.hpp"
#include "experiment/play/arm.hpp"
#include "kicking/random/draws.hpp"
#include "log/shards/shards.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

/// What the arms of an experiment have in common, unless a file says otherwise.
struct ArmBase {
  std::string config;                  ///< settings of the nodes
  std::vector<std::string> overrides;  ///< settings on top
  std::vector<std::string> robots;     ///< robot files; empty: the calibrated ones
  std::string dashes{};                ///< "--" where sentences call all that is given by flags
};

/// The arms that `text` names: policies such as "stopped,moving,predictive", each "@old" or "@new" where it plays with
/// that height table, or a file of arms (ending in .toml). Throws config::BadArgument and config::Error with the name
/// that is none.
std::vector<Arm> arms_of(const std::string& text, const ArmBase& base);

/// The arms of a file's [[arm]] tables, or of a text of them. Throws as above.
std::vector<Arm> arms_of(const std::vector<config::ArmFields>& arms, const ArmBase& base);

/// A sentence where an arm has fewer robot files than the scenario's team has robots, each once.
std::vector<std::string> shared_robots(const sim::Scenario& scenario, const std::vector<Arm>& arms);

/// Everybody who may be in charge in the arm.
std::vector<kicking::PolicyName> policies_in(const Arm& arm);

/// An arm as text: all that its rows depend on. A policy from outside changes with its code, not with the version.
std::string describe(const Arm& arm);

/// The settings that an arm plays by: those of the file `config`, then `overrides`, then the arm's own lines. Throws
/// config::BadArgument for a line that names what plays no part in process, with what to use instead, and for one
/// that says who plays where the arm does, too; config::Error naming line, key and value where it cannot be read.
config::Settings arm_settings(const config::ArmFields& arm, const std::string& config,
                              std::vector<config::SettingLine> overrides);

/// The robots of one team as a calibration left them, robot n's at n - 1.
using Team = std::vector<config::Robot>;

/// Calibrations as text.
std::string describe(const std::vector<Team>& calibrations);

inline constexpr std::uint64_t kCalibrationSeeds =
    1'000'001;  ///< 0 to 1e6, as `trivela calibrate run --seed` takes them

/// The seed of one robot's calibration, a pure function of the experiment's seed.
inline std::uint64_t calibration_seed(std::uint64_t seed, std::uint32_t calibration, std::uint32_t robot_id) {
  const auto words = kicking::philox4x32({calibration, robot_id, 0, 0x4556454e},
                                         {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  return (std::uint64_t{words[0]} << 32 | words[1]) % kCalibrationSeeds;
}

/// How much is played.
struct PlayPlan {
  std::uint64_t seed = 1;
  std::uint32_t matches = 1;       ///< of each arm
  std::uint32_t possessions = 60;  ///< a match
  unsigned jobs = 1;               ///< threads
  /// Teams as calibrations left them. Match m is played with team m mod their number, in every arm but one that has
  /// robots of its own: every calibration has as many matches, give or take one. Empty: each arm's robots.
  std::vector<Team> calibrations{};
  std::optional<log::Shard> shard{};  ///< whose share of the matches is played; none: all of them

  /// The matches that are played.
  log::MatchRange range() const { return log::range_of(shard, matches); }

  /// The number of a match's calibration; 0 where there are none.
  std::uint32_t calibration_of(std::uint32_t match) const {
    return calibrations.empty() ? 0 : match % static_cast<std::uint32_t>(calibrations.size());
  }

  /// The arm as it plays the match.
  Arm in_match(std::uint32_t match, Arm arm) const {
    if (!calibrations.empty() && !arm.own_robots) arm.robots = calibrations[calibration_of(match)];
    return arm;
  }
};

/// Throws config::BadArgument where `base` names robot files, too, and where there are more calibrations than matches.
void check_calibrations(const ArmBase& base, std::uint32_t calibrations, std::uint32_t matches);

/// The teams that so many calibrations before the plan's matches leave behind. The same for any number of jobs.
/// `progress`: calibrations of robots that were played, of how many; called by one thread at a time.
std::vector<Team> calibrated_teams(const sim::Scenario& world, std::uint32_t calibrations, const PlayPlan& plan,
                                   const std::function<void(std::size_t done, std::size_t all)>& progress);

}  // namespace trivela::experiment
