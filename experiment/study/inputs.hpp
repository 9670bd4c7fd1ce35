#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kicking/policy/policy_config.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

/// An input of the world that nobody measured, or few did, or a setting of the policies that somebody chose, and how
/// far it may be off. Values in the unit of its key; a law's is its place among those that the key may name, from 0.
struct UncertainInput {
  std::string key;  ///< as in a scenario file, "kicker.delay_s", or in default.toml, "policy.settle_s"
  double low;
  double high;
  std::string why;  ///< these two
};

/// A table of columns key, low, high and why, such as config/studies/sensitivity.csv. Throws config::Error naming file,
/// line and key for a key or a value that is none, and for an empty table.
std::vector<UncertainInput> load_inputs(const std::string& path);

/// Whether it can change anything: a keeper's where there is one, defenders' where there are some, all others always.
bool in_force(const sim::Scenario& scenario, const UncertainInput& input);

/// Is it a setting of the policies?
bool is_setting(std::string_view key);

/// The value of `key` in the unit of its name. Throws std::invalid_argument for a key that is no number there.
double value_of(const sim::Scenario& scenario, const std::string& key);
double value_of(const kicking::PolicyConfig& policy, const std::string& key);

/// The scenario, or the settings, with another value there. Throws std::invalid_argument as value_of(), and for a
/// value that is refused there.
sim::Scenario with(const sim::Scenario& scenario, const std::string& key, double value);
kicking::PolicyConfig with(const kicking::PolicyConfig& policy, const std::string& key, double value);

/// The value for people: a law by its name.
std::string value_text(const std::string& key, double value);

}  // namespace trivela::experiment
