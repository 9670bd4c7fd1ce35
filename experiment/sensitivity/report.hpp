#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "experiment/sensitivity/analysis.hpp"

namespace trivela::experiment {

std::string to_text(const SensitivityReport& report);
nlohmann::ordered_json to_json(const SensitivityReport& report);

/// A row an input, end and arm: input, value, arm, opportunities, kicks, on_target; and a headline's change with its
/// interval where the arm has one before it. The scenario's own values are the rows of input "".
std::string to_csv(const SensitivityReport& report);

/// A bar an input and headline, from its change at the low value to that at the high one, the largest on top.
std::string to_svg(const SensitivityReport& report);

}  // namespace trivela::experiment
