#pragma once

#include <array>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "config/scenario/scenario.hpp"
#include "config/settings.hpp"
#include "experiment/study/study.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

/// How arms compare on the same matches: each with the first.
Study arms_study(const sim::Scenario& scenario, const std::vector<Arm>& arms);

/// How arms stand worlds that are not what the robots believe: in each world, every arm with `rival`, which is one of
/// them. The first world is the scenario as it is.
Study robustness_study(const std::vector<Arm>& arms, const std::string& rival,
                       const std::vector<config::NamedWorld>& worlds);

/// Efficiency against volume: `policy` with each of the thresholds, beside arms without one, the last the oracle.
Study frontier_study(const sim::Scenario& scenario, const Arm& policy, const std::set<double>& thresholds,
                     const std::vector<Arm>& beside);

/// Efficiency of the frontier, the rows with a threshold, minus that of `fixed` at its own number of kicks, the
/// interval within [-1, 1]. Between two thresholds the frontier is what a team gets that plays some possessions with
/// the one and the rest with the other: kicks and shots on target both linear. Beyond them all it is the nearest one.
/// Not finite: `fixed` has no kick, or no threshold has.
Effect frontier_above(const std::vector<StudyRow>& rows, const StudyRow& fixed);

/// Laws of height and motion together, from the paper's words to the exact ones: "paper" as printed, "released" with
/// the extended range of the released code, "exact". Directions go by the paper's lines in all.
inline constexpr std::array kFactorialLaws{"paper", "released", "exact"};

/// {old, new table} x ({stopped, moving} x law, predictive), 14 cells of kind "cell"; predictive has no law. Then the
/// old table and `stopped` against the new one and `moving`, as the paper's two tournaments, both with `law`:
/// - kind "sweep": by the opponents' median distance [m]
/// - kind "bias": by the error of the person who made the old table [m]; balls so much too high seemed right then
/// `like`: settings and robots of all. An old table is drawn for each match.
/// It answers with main effects and interactions, each averaged over all levels of the other two factors; last "gain",
/// from the old table and `stopped` to the new one and `moving`: calibration and motion, each as the mean of both
/// orders of introducing them, add up to it. Of a sweep it says where the kick ratio is the paper's 2.03, linear
/// between points, and where its 95 % interval begins and ends to have it.
Study factorial_study(const sim::Scenario& scenario, const Arm& like, const std::string& law,
                      const std::set<double>& opponent_medians_m, const std::set<double>& eye_biases_m);

/// An input of the world that nobody measured, or few did, or a setting of the policies that somebody chose, and how
/// far it may be off. Values in the unit of its key, those of a law are names.
struct UncertainInput {
  std::string key;  ///< as in a scenario file, "kicker.delay_s", or in default.toml, "policy.settle_s"
  std::string low;
  std::string high;
  std::string why;  ///< these two
};

/// A table of columns key, low, high and why, such as config/studies/sensitivity.csv. Throws config::Error naming file,
/// line and key for a key or a value that is none, and for an empty table.
std::vector<UncertainInput> load_inputs(const std::string& path);

/// Whether it can change anything: a keeper's where there is one, defenders' where there are some, all others always.
bool in_force(const sim::Scenario& scenario, const UncertainInput& input);

/// What has the inputs: a world, and how an arm plays in it.
struct Inputs {
  sim::Scenario scenario{};
  config::Settings settings{};
};

/// The value of `key` in the unit of its name, a law's name. Throws config::Error for a key that is neither there.
std::string value_of(const Inputs& inputs, const std::string& key);

/// With another value there. Throws config::Error as value_of(), and for a value that is refused there.
Inputs with(Inputs inputs, const std::string& key, const std::string& value);

/// Each input at its low and its high value, one at a time: how far that changes the difference between each arm and
/// the one before it. Inputs that change one the most come first. A value that the scenario has is not played; one for
/// which its other values leave no room is not either, and `left_out` is told why. `measure`: on target per
/// opportunity, or goals. Throws config::Error.
Study sensitivity_study(const sim::Scenario& scenario, const std::vector<Arm>& arms,
                        const std::vector<UncertainInput>& inputs, Measure measure,
                        const std::function<void(const std::string& why)>& left_out);

}  // namespace trivela::experiment
