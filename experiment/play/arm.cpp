#include "experiment/play/arm.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "sim/kicker/hand_table.hpp"
#include "sim/kicker/kicker.hpp"
#include "sim/scenario_fields.hpp"

namespace trivela::experiment {

std::uint8_t team_size(const sim::Scenario& scenario) { return static_cast<std::uint8_t>(scenario.team.robots); }

config::Settings settings_of(const Arm& arm, const PlayOptions& options) {
  config::Settings settings = arm.settings;
  config::KickDecision& decision = settings.kick_decision;
  decision.shadows = options.shadows;
  if (arm.random.empty() && !arm.policy) return settings;
  decision.put_in_charge(arm.policy.value_or(kicking::PolicyName::kMoving));
  for (const robot::PolicyChance& chance : arm.random) {
    decision.random.push_back(chance.policy);
    decision.random_probabilities.push_back(chance.probability);
  }
  return settings;
}

config::Robot robot_of(const sim::Scenario& scenario, const Arm& arm, std::uint64_t seed, std::uint32_t match_id,
                       std::uint8_t robot_id) {
  const config::Settings settings = settings_of(arm, {});
  config::Robot robot = arm.robots[std::min<std::size_t>(robot_id, arm.robots.size()) - 1];
  if (arm.table != kOldTable) return config::robot_for(std::move(robot), settings);
  const std::uint32_t whose = scenario.hand_table.one_for_all ? 1 : robot_id;
  robot.height_table = sim::draw_hand_table(scenario, sim::team_kicker(scenario, whose), seed, match_id, whose);
  return config::robot_for(std::move(robot), settings);
}

std::optional<kicking::PolicyName> only_policy(const sim::Scenario& scenario, const Arm& arm) {
  const config::KickDecision settings = settings_of(arm, {}).kick_decision;
  std::optional<kicking::PolicyName> only;
  for (std::uint8_t robot_id = 1; robot_id <= team_size(scenario); ++robot_id) {
    const robot::PolicyAssignment assignment{settings, robot_id};
    const kicking::PolicyName policy = assignment.in_charge(1, 1).policy;
    if (assignment.random() || (only && *only != policy)) return std::nullopt;
    only = policy;
  }
  return only;
}

void check_playable(const sim::Scenario& scenario, const Arm& arm, std::uint32_t possessions) {
  if (possessions == 0) throw std::runtime_error{"a match of no possessions"};
  if (const auto problem = sim::first_problem(scenario))
    throw std::runtime_error{fmt::format("scenario: {}: {}", problem->key, problem->why)};
  if (arm.robots.empty()) throw std::runtime_error{"arm " + arm.name + " has no robot"};
  if (arm.table != kNewTable && arm.table != kOldTable)
    throw std::runtime_error{"arm " + arm.name + ": table \"" + arm.table + "\" is neither new nor old"};
  if (scenario.cycle_s != arm.settings.run.cycle_s) {
    throw std::runtime_error{fmt::format("arm {}: run.cycle_s = {} differs from the scenario's cycle_s = {}", arm.name,
                                         arm.settings.run.cycle_s, scenario.cycle_s)};
  }
  config::check_policies(settings_of(arm, {}).kick_decision, "arm " + arm.name);
}

}  // namespace trivela::experiment
