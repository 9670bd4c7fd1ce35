#pragma once

#include <string>
#include <vector>

#include "experiment/play/arm.hpp"
#include "kicking/policy/policy_config.hpp"

namespace trivela::experiment {

/// Height and motion law together, from the paper's words to the exact ones. Directions go by the paper's lines in all.
enum class Law {
  kPaper,     ///< range law, V_kick = V0 - k v cos(theta): the paper as printed
  kReleased,  ///< extended range, the same V_kick: the released code
  kExact      ///< crossing of the target, velocities added at the release
};

const char* name(Law law);

/// One cell of the factorial.
struct Cell {
  std::string table;  ///< "old" or "new"
  kicking::PolicyName policy{};
  Law law = Law::kExact;

  /// "old stopped paper"; "new predictive", which predicts and has no law.
  std::string name() const;
};

/// {old, new} x ({stopped, moving} x law, predictive): 14 cells.
std::vector<Cell> factorial_cells();

/// The cell as an arm. `settings` and `robots` are what all cells share; an old table is drawn for each match.
Arm arm_of(const Cell& cell, const config::Settings& settings, const std::vector<config::Robot>& robots);

}  // namespace trivela::experiment
