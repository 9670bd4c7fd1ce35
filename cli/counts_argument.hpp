#pragma once

#include <string>
#include <utility>
#include <vector>

#include "evaluator/report/comparison.hpp"

namespace trivela::cli {

/// Most kicks in a count; far beyond any season, and exact tests still end.
inline constexpr std::int64_t kMaxKicks = 1'000'000'000;

/// "old=34/65" is 34 of 65 kicks inside, under the name "old". Throws UsageError quoting the argument.
evaluator::NamedCounts parse_counts(const std::string& argument);

/// The older and the newer of exactly two counts. Throws UsageError.
std::pair<evaluator::NamedCounts, evaluator::NamedCounts> parse_two_counts(const std::vector<std::string>& arguments);

}  // namespace trivela::cli
