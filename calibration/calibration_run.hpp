#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "calibration/drive_source.hpp"
#include "calibration/robot_update.hpp"
#include "config/settings.hpp"
#include "kicking/fit/tracked_fits.hpp"

namespace trivela::calibration {

/// Of the turn drive: robot's centre to target (paper, section 3.3).
inline constexpr double kTurnDistance_m = 8.0;

/// How much is kicked.
struct CalibrationEffort {
  std::uint32_t kicks = 16;        ///< standing: with each set-point, a round
  std::uint32_t lobs = 3;          ///< accepted ones that each set-point shall have; more rounds until it has them
  std::uint32_t rounds = 4;        ///< at most
  std::uint32_t drive_kicks = 8;   ///< lateral, straight: with each velocity
  std::uint32_t kind_kicks = 4;    ///< of each further kind of kick: with each set-point
  std::uint32_t turn_kicks = 3;    ///< turn: with each step of the bisection
  std::uint32_t check_kicks = 40;  ///< possessions of the check
};

/// One drive, as it went.
struct DriveSummary {
  std::string name;
  std::vector<std::string> logs;
  std::size_t kicks = 0;  ///< that were seen
  std::size_t used = 0;   ///< of those, that a fit rests on
  double played_s = 0.0;
  double wall_s = 0.0;
  std::string found;                  ///< one line on the figures
  std::vector<std::string> left_out;  ///< kinds of kicks without use
};

/// The calibration's procedure: each step plays its matches, fits, and brings the robot up to date with what was found.
/// All that a fit sees is what the robot and the laser recorded. Throws what the source throws, and std::runtime_error
/// where there are too few kicks, saying how many more are needed.
class CalibrationRun {
 public:
  /// `source` outlives it. The drives have the seeds `seed`, `seed` + 1, ...
  /// `standing_to_goal_m`: where the ball lies for the standing kicks.
  CalibrationRun(DriveSource& source, double standing_to_goal_m, const config::Settings& settings,
                 const CalibrationEffort& effort, std::int64_t seed, RobotUpdate update);

  DriveSummary standing();   ///< laser: table and exit angle (paper, section 2)
  DriveSummary delay();      ///< of the same kicks, by the flight camera
  DriveSummary direction();  ///< sideways scatter of the same kicks
  DriveSummary lateral();    ///< alpha (section 3.2)
  DriveSummary turn();       ///< beta (section 3.3)
  DriveSummary straight();   ///< transfer, forward and backward

  /// A further kind of kick, standing as for the first, by the flight camera: table, delay, scatter.
  DriveSummary low_kind(std::size_t kind);

  /// All of them in that order, each said when it is done; then each further kind of kick of the robot.
  std::vector<DriveSummary> calibration(const std::function<void(const DriveSummary&)>& said);

  const RobotUpdate& robot() const { return update_; }

 private:
  /// Rounds of standing kicks until each set-point has its lobs.
  void play_standing(DriveSummary& summary);
  /// The standing kicks that the flight camera followed, with the lobs that the laser saw of them.
  std::vector<kicking::TrackedTrial> followed() const;
  DriveRecord play(DriveSummary& summary, const std::string& name, kicking::PolicyName policy, double ball_to_goal_m,
                   bool laser, std::size_t possessions, std::vector<std::string> settings);

  DriveSource& source_;
  double standing_to_goal_m_;
  config::Settings settings_;
  CalibrationEffort effort_;
  std::int64_t seed_;
  RobotUpdate update_;
  std::vector<DriveRecord> standing_;
  std::vector<kicking::TransferRow> lateral_;  ///< kicks of the lateral drive
};

}  // namespace trivela::calibration
