#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "config/robot.hpp"
#include "config/settings.hpp"
#include "experiment/calibration/simulated_calibration.hpp"
#include "log/read/reader.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

/// How far the kicks of a match went from where they were aimed. A kick without a crossing counts as infinitely far.
struct AimErrors {
  std::size_t kicks = 0;
  std::size_t without_crossing = 0;
  double median_height_m = 0.0;    ///< of |crossing height - target height|
  double median_sideways_m = 0.0;  ///< of |crossing x - target x|
};

/// By what the robot saw.
AimErrors observed_errors(std::span<const log::Kick> kicks, const config::Settings& settings);

/// By the simulator's truth: for a report alone.
AimErrors true_errors(std::span<const log::Kick> kicks, const config::Settings& settings);

/// A calibrated figure beside the world's.
struct WorldFigure {
  std::string key;
  double calibrated = 0.0;
  double world = 0.0;
};

/// WorldFigure::key of a set-point's exit speed.
std::string exit_speed_key(double power);

/// The robot's figures beside what the scenario's world would show a test drive without noise: effective values of its
/// true table; alpha and beta as the fits' lines over the drives' own velocities, by rigid-body velocities from the
/// true exit of the power that each drive kicks with; the delay as it is; transfer as that of the drag-free law: the
/// world's times effective over true horizontal speed of the power that the drives kick with. Read from the scenario,
/// for a report alone: no fit ever sees it.
std::vector<WorldFigure> against_world(const config::Robot& robot, const sim::Scenario& world,
                                       const config::Settings& settings);

/// A figure over many calibrations of one world, beside the world's own.
struct StudiedFigure {
  std::string key;
  double world = 0.0;
  double mean = 0.0;     ///< over the calibrations
  double rms = 0.0;      ///< of figure - world
  double mean_se = 0.0;  ///< root mean square of the standard errors that the calibrations gave
  double covered = 0.0;  ///< share of the calibrations whose figure +- 1.96 standard errors contains the world's
  std::size_t calibrations = 0;
};

/// Every figure that a calibration gives with a standard error. The world's: against_world(); of alpha and beta, which
/// count from where the robot believes it points, with its filters' lag, what a calibration finds in the same world
/// without any noise of kicker and sensors.
std::vector<StudiedFigure> study_figures(std::span<const SimulatedCalibration> calibrations,
                                         const SimulatedCalibrationOptions& options);

/// Balls on target per opportunity of each calibration's robot with a policy, by the simulator's truth: the same
/// `matches` matches of 20 possessions in `world` for all, so that the calibrations differ by their robots alone.
std::vector<double> study_policy(std::span<const SimulatedCalibration> calibrations, const sim::Scenario& world,
                                 const config::Settings& settings, kicking::PolicyName policy, std::uint32_t matches,
                                 std::uint64_t seed, std::size_t jobs);

}  // namespace trivela::experiment
