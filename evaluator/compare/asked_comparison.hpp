#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/counting/log_kicks.hpp"

namespace trivela::evaluator {

/// An option says what makes no sense for this comparison; the message begins with the option.
struct BadChoice : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// What somebody wants to know of kicks.
struct ComparisonQuestion {
  LogKicks kicks{};                                 ///< how logs are read
  std::string baseline{};                           ///< group that the others are compared with; empty: the first
  std::string design{};                             ///< label of a Design; empty: what the data say
  double smallest_effect = stats::kSmallestEffect;  ///< smallest difference of interest, 0 to 1
};

/// Throws BadChoice where the question makes no sense whatever the kicks are: an unknown design, a smallest effect that
/// is not between 0 and 1.
void check(const ComparisonQuestion& question);

/// compare_policies() with that baseline and design. `by` is what the groups are. Throws BadChoice for a baseline that
/// is no group and for strata that are the groups; std::runtime_error as compare_policies().
PolicyComparison compare_dataset(KickDataset dataset, const std::string& by, const ComparisonQuestion& question);

/// The sessions of all logs together, with what differs between the logs, and of two logs each group between them.
/// Throws BadChoice and BadOption, whose messages begin with the option, and std::runtime_error naming a log that
/// cannot be read.
PolicyComparison compare_logs(const std::vector<std::filesystem::path>& logs, const ComparisonQuestion& question);

}  // namespace trivela::evaluator
