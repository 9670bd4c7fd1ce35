#pragma once

#include <span>
#include <string>
#include <vector>

#include "evaluator/report/log_kicks.hpp"
#include "evaluator/report/policy_comparison.hpp"

namespace trivela::evaluator {

/// Each of `groups`, policies or arms as `by` says, in the later logs against the first: yesterday against today. Their
/// p are adjusted together. `options` are those of the comparison of the groups.
std::vector<BetweenLogs> between_logs(const LoggedOpportunities& logged, std::span<const std::string> groups,
                                      const std::string& by, LogKicks options, double smallest_effect);

/// A line for each, and what the design allows to be said; empty where there is none.
std::string between_logs_text(std::span<const BetweenLogs> between);

}  // namespace trivela::evaluator
