#pragma once

#include <cstdint>

#include "kicking/policy/policy.hpp"
#include "sim/scenario.hpp"
#include "sim/truth.hpp"

/// What the policy `oracle` is given in place of a robot's belief: everything here is the simulator's truth, which no
/// other policy may see. It says what better knowledge could buy the rule of `predictive`, with its steps and its blind
/// spot (the opponents' bearings, without policy.predictive.opponent_places); other rules may be better than it.
namespace trivela::experiment {

/// A robot that knows its kicker: the true table as the effective one that its flights would be measured as
/// (sim::effective_exit), true delay and transfer, and the spreads that each kick is drawn from. It has as many kinds
/// of kick as the robot whose place it takes, 2 at most.
kicking::RobotModel oracle_robot(const sim::Scenario& scenario, const sim::Kicker& kicker, std::size_t kinds = 1);

/// The settings of a robot that knows its own state and the opponent's exactly: no spread, no lag; the referee's time
/// limit is the only other hazard.
kicking::PolicyConfig oracle_config(const kicking::PolicyConfig& config, const sim::Scenario& scenario);

/// The true state as a policy's input.
kicking::PolicyInput oracle_input(const sim::TrueState& state, std::int64_t t_ns, bool playing,
                                  std::uint32_t possession_id, bool kicker_ready);

}  // namespace trivela::experiment
