#pragma once

#include <string>

#include "evaluator/report/table2.hpp"

namespace trivela::evaluator {

/// Aligned tables for a terminal: Table 2, why the misses missed, data quality.
std::string to_text(const Report& report);

/// One line a policy with a header. A cell is empty where there is no such number.
std::string to_csv(const Report& report);

/// `policies: [{policy, inside, outside, efficiency, wilson95, ...}]`, `sessions`, `data_quality` and notes.
/// null where there is no such number.
std::string to_json(const Report& report);

}  // namespace trivela::evaluator
