#include "experiment/run/calibrations.hpp"

#include <fmt/core.h>

#include <stdexcept>

#include "config/text/error.hpp"
#include "experiment/calibration/simulated_calibration.hpp"
#include "experiment/run/in_threads.hpp"

namespace trivela::experiment {
namespace {

/// What the calibration left behind, without the day on which it was computed: the same plan makes the same log
/// tomorrow.
config::Robot robot_of(const sim::Scenario& world, const RepeatedCalibration& plan, std::uint32_t calibration,
                       std::uint32_t robot_id) try {
  config::Robot robot =
      calibrated_robot(world, static_cast<std::int64_t>(calibration_seed(plan.seed, calibration, robot_id)), robot_id);
  robot.name = fmt::format("calibration_{}_robot_{}", calibration, robot_id);
  robot.calibration.reset();
  return robot;
} catch (const std::exception& error) {
  throw std::runtime_error{fmt::format("calibration {}, robot {}: {}", calibration, robot_id, error.what())};
}

}  // namespace

void check_calibrations(const ArmBase& base, std::uint32_t calibrations, std::uint32_t matches) {
  const std::string called = base.before_numbers + "calibrations";
  if (calibrations > 0 && !base.robots.empty()) {
    throw config::BadArgument{
        fmt::format("{} and {} {}: robots are those of files or of calibrations; leave one out ({} 0)",
                    base.robots_called, called, calibrations, called)};
  }
  if (calibrations > matches) {
    throw config::BadArgument{
        fmt::format("{} {}: more calibrations than {}matches {}", called, calibrations, base.before_numbers, matches)};
  }
}

std::vector<Team> calibrated_teams(const sim::Scenario& world, const RepeatedCalibration& plan,
                                   const std::function<void(std::size_t done, std::size_t all)>& progress) {
  const std::uint32_t robots = team_size(world);
  std::vector<Team> teams(plan.calibrations, Team(robots));
  const auto play = [&](std::size_t i) {
    const auto calibration = static_cast<std::uint32_t>(i / robots), robot = static_cast<std::uint32_t>(i % robots);
    teams[calibration][robot] = robot_of(world, plan, calibration, robot + 1);
  };
  in_threads(std::size_t{plan.calibrations} * robots, plan.jobs, play, progress);
  return teams;
}

}  // namespace trivela::experiment
