#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/robot.hpp"
#include "config/settings.hpp"
#include "kicking/policy/policy.hpp"
#include "robot/decision/assignment.hpp"
#include "sim/scenario.hpp"
#include "sim/sensors.hpp"

namespace trivela::experiment {

inline constexpr const char* kNewTable = "new";  ///< the robot files' own tables
inline constexpr const char* kOldTable = "old";  ///< another hand-made one for each match (sim/kicker/hand_table.hpp)

/// One way to play: what the robots decide by and what they know of themselves. The same opportunities can be played
/// with any number of arms.
struct Arm {
  std::string name{};
  /// In charge, where `random` is empty; none: who plays is said by settings.kick_decision, as on the bus.
  std::optional<kicking::PolicyName> policy = kicking::PolicyName::kMoving;
  std::string table = kNewTable;  ///< height tables: kNewTable or kOldTable
  config::Settings settings{};
  std::vector<config::Robot> robots{config::Robot{}};  ///< robot n's at n - 1; a team may have more, its rest the last
  std::vector<robot::PolicyChance> random{};           ///< drawn for each possession
  bool own_robots = false;                             ///< calibrations of an experiment leave `robots` as they are
};

/// What is recorded beside the possessions.
struct PlayOptions {
  bool shadows = false;                              ///< the policies that are not in charge decide as well
  bool every_cycle = false;                          ///< record every decision, not only those that fire
  std::function<void(const sim::Sensors&)> watch{};  ///< gets what every cycle's sensors say; none: nobody looks
};

/// The arm's settings as its robots play by them, but for kick_decision.assignment_seed, which is the match's.
config::Settings settings_of(const Arm& arm, const PlayOptions& options);

/// How many of our robots play.
std::uint8_t team_size(const sim::Scenario& scenario);

/// What a robot, counted from 1, knows of itself in a match of this arm. Throws config::Error where the old table that
/// is drawn for it cannot be used: no ball reaches the target's height from one of its distances.
config::Robot robot_of(const sim::Scenario& scenario, const Arm& arm, std::uint64_t seed, std::uint32_t match_id,
                       std::uint8_t robot_id);

/// The policy of all possessions of a match, where it is one and the same for every robot of the team.
std::optional<kicking::PolicyName> only_policy(const sim::Scenario& scenario, const Arm& arm);

/// Throws std::runtime_error in a sentence that names the arm, where play_match() could not play it: for a scenario
/// that sim::first_problem() refuses or whose cycle is not the settings', no possessions, no robot, a table that is
/// none, and policies that make no sense together.
void check_playable(const sim::Scenario& scenario, const Arm& arm, std::uint32_t possessions);

}  // namespace trivela::experiment
