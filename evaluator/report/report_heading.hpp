#pragma once

#include <string>
#include <vector>

#include "evaluator/report/table2.hpp"

namespace trivela::evaluator {

/// Sentences on what was played: the arms of experiments, other sessions one by one. What belongs to the one before
/// begins with two blanks.
std::vector<std::string> heading_of(const Report& report);

}  // namespace trivela::evaluator
