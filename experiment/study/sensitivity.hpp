#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "experiment/study/study.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

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
