#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "experiment/frontier/analysis.hpp"

namespace trivela::experiment {

std::string to_text(const FrontierReport& report);
nlohmann::ordered_json to_json(const FrontierReport& report);

/// A row a point: policy, threshold (empty without one), opportunities, kicks, on_target, kicks_per_opportunity,
/// efficiency, per_opportunity, each share with its interval, empty where there are too few kicks.
std::string to_csv(const FrontierReport& report);

/// Efficiency over kicks per opportunity: the frontier as a line, the others as dots, with intervals where there are
/// kicks enough.
std::string to_svg(const FrontierReport& report);

}  // namespace trivela::experiment
