#pragma once

#include <string>
#include <vector>

#include "evaluator/stats/counts/counts.hpp"

namespace trivela::evaluator {

/// Columns padded to their widest cell, two blanks between them: the first to the left, the others to the right.
/// The first row is the head. Each line is indented by two blanks and ends with a newline.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// "52.3 %".
std::string percent(double fraction);

/// "40.1 % to 63.9 %".
std::string percent(stats::Interval fractions);

/// "on target" of "on_target".
std::string words(std::string label);

}  // namespace trivela::evaluator
