#include "experiment/run/evenings.hpp"

#include <fmt/core.h>

#include <stdexcept>

#include "experiment/evening/evening.hpp"
#include "experiment/run/in_threads.hpp"

namespace trivela::experiment {
namespace {

/// What the evening left behind, without the day on which it was computed: the same plan makes the same log tomorrow.
config::Robot robot_of(const sim::Scenario& world, const EveningPlan& plan, std::uint32_t evening,
                       std::uint32_t robot_id) try {
  config::Robot robot =
      evening_robot(world, static_cast<std::int64_t>(evening_seed(plan.seed, evening, robot_id)), robot_id);
  robot.name = fmt::format("evening_{}_robot_{}", evening, robot_id);
  robot.calibration.reset();
  return robot;
} catch (const std::exception& error) {
  throw std::runtime_error{fmt::format("evening {} of calibration, robot {}: {}", evening, robot_id, error.what())};
}

}  // namespace

std::vector<Team> teams_of_evenings(const sim::Scenario& world, const EveningPlan& plan,
                                    const std::function<void(std::size_t done, std::size_t all)>& progress) {
  const std::uint32_t robots = team_size(world);
  std::vector<Team> teams(plan.evenings, Team(robots));
  const auto play = [&](std::size_t i) {
    const auto evening = static_cast<std::uint32_t>(i / robots), robot = static_cast<std::uint32_t>(i % robots);
    teams[evening][robot] = robot_of(world, plan, evening, robot + 1);
  };
  in_threads(std::size_t{plan.evenings} * robots, plan.jobs, play, progress);
  return teams;
}

}  // namespace trivela::experiment
