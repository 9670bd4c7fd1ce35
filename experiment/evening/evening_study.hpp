#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "experiment/evening/evening.hpp"

namespace trivela::experiment {

/// A figure over many evenings of one world, beside the world's own.
struct StudiedFigure {
  std::string key;
  double world = 0.0;
  double mean = 0.0;     ///< over the evenings
  double rms = 0.0;      ///< of figure - world
  double mean_se = 0.0;  ///< root mean square of the standard errors that the evenings gave
  double covered = 0.0;  ///< share of the evenings whose figure +- 1.96 standard errors contains the world's
  std::size_t evenings = 0;
};

/// Every figure that an evening gives with a standard error. The world's: against_world(); of alpha and beta, which
/// count from where the robot believes it points, with its filters' lag, what an evening finds in the same world
/// without any noise of kicker and sensors.
std::vector<StudiedFigure> study_figures(std::span<const Evening> evenings, const EveningOptions& options);

/// Balls on target per opportunity of each evening's robot with a policy, by the simulator's truth: the same `matches`
/// matches of 20 possessions in `world` for all, so that the evenings differ by their robots alone.
std::vector<double> study_policy(std::span<const Evening> evenings, const sim::Scenario& world,
                                 const config::Settings& settings, kicking::PolicyName policy, std::uint32_t matches,
                                 std::uint64_t seed, std::size_t jobs);

}  // namespace trivela::experiment
