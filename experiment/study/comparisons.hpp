#pragma once

#include <string>
#include <vector>

#include "config/scenario/worlds.hpp"
#include "experiment/study/study.hpp"

namespace trivela::experiment {

/// How arms compare on the same matches: each with the first.
Study arms_study(const sim::Scenario& scenario, const std::vector<Arm>& arms);

/// How arms stand worlds that are not what the robots believe: in each world, every arm with `rival`, which is one of
/// them. The first world is the scenario as it is.
Study robustness_study(const std::vector<Arm>& arms, const std::string& rival,
                       const std::vector<config::NamedWorld>& worlds);

/// Efficiency against volume: `policy` with each of the thresholds, beside arms without one, the last the oracle.
Study frontier_study(const sim::Scenario& scenario, const Arm& policy, const std::vector<double>& thresholds,
                     const std::vector<Arm>& beside);

/// Efficiency of the frontier, the rows with a threshold, minus that of `fixed` at its own number of kicks, the
/// interval within [-1, 1]. Between two thresholds the frontier is what a team gets that plays some possessions with
/// the one and the rest with the other: kicks and shots on target both linear. Beyond them all it is the nearest one.
/// Not finite: `fixed` has no kick, or no threshold has.
Effect frontier_above(const std::vector<StudyRow>& rows, const StudyRow& fixed);

}  // namespace trivela::experiment
