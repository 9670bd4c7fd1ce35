#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/robot.hpp"
#include "config/settings.hpp"
#include "kicking/policy/policy.hpp"
#include "nodes/kick_decision/assignment.hpp"

namespace trivela::nodes {

inline constexpr const char* kNewTable = "new";  ///< the robot files' own tables
inline constexpr const char* kOldTable = "old";  ///< another hand-made one for each match (sim/hand_table.hpp)

/// One way to play: what the robots decide by and what they know of themselves. The same opportunities can be played
/// with any number of arms.
struct Arm {
  std::string name;
  /// In charge, where `random` is empty; none: who plays is said by settings.kick_decision, as on the bus.
  std::optional<kicking::PolicyName> policy = kicking::PolicyName::kMoving;
  std::string table = kNewTable;  ///< height tables: kNewTable or kOldTable
  config::Settings settings{};
  std::vector<config::Robot> robots{config::Robot{}};  ///< robot n's at n - 1; a team may have more, its rest the last
  std::vector<PolicyChance> random;                    ///< drawn for each possession anew
};

}  // namespace trivela::nodes
