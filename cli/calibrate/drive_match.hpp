#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/launch/signal_inbox.hpp"
#include "config/settings.hpp"
#include "sim/scenario.hpp"

namespace trivela::cli {

/// One match of a calibration in simulation.
struct DrivePlan {
  std::string name;  ///< of its files
  kicking::PolicyName policy{};
  sim::Scenario scenario;
  std::uint32_t possessions = 1;
  std::int64_t seed = 1;
  std::vector<std::string> settings;  ///< lines on top, e.g. "policy.test_drive.powers = [15.0]"
};

/// What was recorded.
struct DriveRecord {
  std::filesystem::path log;
  std::filesystem::path scans;  ///< empty: the scenario has no laser
  double played_s = 0.0;
  double wall_s = 0.0;
};

/// Plays matches in lockstep through the real nodes, one after another; each leaves NAME.db, with a laser
/// NAME.scans.db, and the scenario that it played, NAME.scenario.toml, in one folder.
class DriveMatches {
 public:
  /// `settings`: what all matches have in common. `signals` outlives it.
  DriveMatches(config::Settings settings, std::filesystem::path folder, SignalInbox& signals);

  /// Plays with the robot in `robot_file`. Throws UsageError where a file of that name exists, std::runtime_error where
  /// somebody asked to stop, a node died or rows were lost, with what is left on the disk.
  DriveRecord play(const DrivePlan& plan, const std::filesystem::path& robot_file);

 private:
  config::Settings settings_;
  std::filesystem::path folder_;
  SignalInbox& signals_;
};

}  // namespace trivela::cli
