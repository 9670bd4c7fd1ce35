#pragma once

#include <string>
#include <vector>

#include "evaluator/table2/table2.hpp"

namespace trivela::evaluator {

/// Sentences on what was played: the arms of experiments, other sessions one by one. What belongs to the one before
/// begins with two blanks.
std::vector<std::string> heading_of(const Report& report);

/// The `trivela compare` that says how sure the differences of a report are, as a line to copy: by arm, policy, log or
/// robot, whichever there are several of, in that order. Empty where there is nothing to compare: no kick, or replays.
std::string next_comparison(const Report& report);

/// "refused orders, no kicks: 3 x stale (moving); accepted at first and not fired: 1".
std::string line_of(const RefusedOrders& refused);

/// A word as a shell takes it, in quotes where it needs them.
std::string shell_word(const std::string& word);

}  // namespace trivela::evaluator
