#pragma once

#include <span>
#include <string>
#include <vector>

#include "config/robot.hpp"
#include "config/settings.hpp"
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

}  // namespace trivela::experiment
