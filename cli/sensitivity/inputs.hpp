#pragma once

#include <span>
#include <string>

#include "sim/scenario.hpp"

namespace trivela::cli {

/// An input of the world that nobody measured, or few did, and how far it may be off. Values in the unit of its key.
struct UncertainInput {
  const char* key;  ///< as in a scenario file: "kicker.delay_s"
  double low;
  double high;
  const char* why;  ///< these two
};

std::span<const UncertainInput> uncertain_inputs();

/// Whether it can change anything: a keeper's where there is one, defenders' where there are some, all others always.
bool in_force(const sim::Scenario& scenario, const UncertainInput& input);

/// The value of `key` in the unit of its name. @throws std::invalid_argument for a key that is no number of a scenario.
double value_of(const sim::Scenario& scenario, const std::string& key);

/// The scenario with another value there. @throws std::invalid_argument as value_of(), and for a scenario that
/// sim::first_problem() then refuses.
sim::Scenario with(const sim::Scenario& scenario, const std::string& key, double value);

}  // namespace trivela::cli
