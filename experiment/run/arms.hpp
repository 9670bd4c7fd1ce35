#pragma once

#include <string>
#include <vector>

#include "config/arms.hpp"
#include "config/settings.hpp"
#include "experiment/play/arm.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

/// What the arms of an experiment have in common, unless a file says otherwise.
struct ArmBase {
  std::string config;                  ///< settings of the nodes
  std::vector<std::string> overrides;  ///< settings on top
  std::vector<std::string> robots;     ///< robot files; empty: the calibrated ones
  std::string arms_called = "arms";    ///< in sentences on the arms' text
  std::string set_called = "set";      ///< in sentences on the overrides
  std::string robots_called = "robots";
  std::string before_numbers{};  ///< "--" where sentences call matches and calibrations by flags
};

/// The arms that `text` names: policies such as "stopped,moving,predictive", each "@old" or "@new" where it plays with
/// that height table, or a file of arms (ending in .toml). Throws config::BadArgument and config::Error with the name
/// that is none.
std::vector<Arm> arms_of(const std::string& text, const ArmBase& base);

/// The arms of a file's [[arm]] tables, or of a text of them. Throws as above.
std::vector<Arm> arms_of(const std::vector<config::ArmFields>& arms, const ArmBase& base);

/// A sentence where an arm has fewer robot files than the scenario's team has robots, each once.
std::vector<std::string> shared_robots(const sim::Scenario& scenario, const std::vector<Arm>& arms);

/// Everybody who may be in charge in the arm.
std::vector<kicking::PolicyName> policies_in(const Arm& arm);

/// An arm as text: all that its rows depend on. A policy from outside changes with its code, not with the version.
std::string describe(const Arm& arm);

/// The settings that an arm plays by: those of the file `config`, then `overrides`, then the arm's own lines. Throws
/// config::BadArgument for a line that names what plays no part in process, with what to use instead, and for one
/// that says who plays where the arm does, too; config::Error naming line, key and value where it cannot be read.
config::Settings arm_settings(const config::ArmFields& arm, const std::string& config,
                              std::vector<config::SettingLine> overrides);

}  // namespace trivela::experiment
