#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "experiment/calibration/simulated_calibration.hpp"

namespace trivela::experiment {

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
