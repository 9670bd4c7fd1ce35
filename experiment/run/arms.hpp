#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "config/arms.hpp"
#include "config/settings.hpp"
#include "experiment/play/arm.hpp"
#include "kicking/random/draws.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

/// What the arms of an experiment have in common, unless a file says otherwise.
struct ArmBase {
  std::string config;                  ///< settings of the nodes
  std::vector<std::string> overrides;  ///< settings on top
  std::vector<std::string> robots;     ///< robot files; empty: the calibrated ones
  std::string arms_called = "arms";    ///< in sentences on the arms' text
  std::string set_called = "set";      ///< in sentences on the overrides
  std::string robots_called = "robots";
  std::string before_numbers{};  ///< "--" where sentences call matches and calibrations by flags
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

/// The arms of an experiment in each calibration. Match m is played with calibration m mod K: every calibration has
/// the same number of matches, give or take one, and all arms of a match have the same.
class CalibratedArms {
 public:
  /// `calibrations` empty: the arms as they are, in every match. An arm with own_robots keeps them.
  CalibratedArms(const std::vector<Arm>& arms, const std::vector<Team>& calibrations) {
    arms_.assign(calibrations.empty() ? 1 : calibrations.size(), arms);
    for (std::size_t k = 0; k < calibrations.size(); ++k) {
      for (Arm& arm : arms_[k]) {
        if (!arm.own_robots) arm.robots = calibrations[k];
      }
    }
  }

  std::uint32_t calibrations() const { return static_cast<std::uint32_t>(arms_.size()); }
  std::uint32_t calibration_of(std::uint32_t match) const { return match % calibrations(); }
  const std::vector<Arm>& of(std::uint32_t match) const { return arms_[calibration_of(match)]; }

 private:
  std::vector<std::vector<Arm>> arms_;  // by calibration
};

inline constexpr std::uint64_t kCalibrationSeeds =
    1'000'001;  ///< 0 to 1e6, as `trivela calibrate run --seed` takes them

/// The seed of one robot's calibration, a pure function of the experiment's seed.
inline std::uint64_t calibration_seed(std::uint64_t seed, std::uint32_t calibration, std::uint32_t robot_id) {
  const auto words = kicking::philox4x32({calibration, robot_id, 0, 0x4556454e},
                                         {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  return (std::uint64_t{words[0]} << 32 | words[1]) % kCalibrationSeeds;
}

/// Which calibrations an experiment plays before its matches.
struct RepeatedCalibration {
  std::uint32_t calibrations = 0;  ///< 0: none, robots are those of the files
  std::uint64_t seed = 1;          ///< of the experiment
  unsigned jobs = 1;               ///< threads
};

/// Throws config::BadArgument where `base` names robot files, too, and where there are more calibrations than matches.
void check_calibrations(const ArmBase& base, std::uint32_t calibrations, std::uint32_t matches);

/// The teams that the calibrations leave behind. The same for any number of jobs. `progress`: calibrations of robots
/// that were played, of how many; called by one thread at a time.
std::vector<Team> calibrated_teams(
    const sim::Scenario& world, const RepeatedCalibration& plan,
    const std::function<void(std::size_t done, std::size_t all)>& progress = [](auto, auto) {});

}  // namespace trivela::experiment
