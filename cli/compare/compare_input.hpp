#pragma once

#include <istream>
#include <string>
#include <utility>
#include <vector>

#include "evaluator/compare/comparison.hpp"
#include "evaluator/counting/kick_dataset.hpp"

namespace trivela::cli {

/// "old=34/65" is 34 of 65 kicks inside, under the name "old". Throws UsageError quoting the argument.
evaluator::NamedCounts parse_counts(const std::string& argument);

/// The older and the newer of exactly two counts. Throws UsageError.
std::pair<evaluator::NamedCounts, evaluator::NamedCounts> parse_two_counts(const std::vector<std::string>& arguments);

/// What to make of a table of kicks.
struct CsvComparison {
  std::string by = "policy";  ///< column with the groups
  std::string stratify;       ///< column with the situations; "distance" for bins of distance_m; empty: none
  bool paired = false;        ///< the same opportunities are said to have been played by every group
};

/// Reads a table of kicks, or of opportunities: columns `policy` (or the one of `by`) and `on_target` (1, 0; empty:
/// unknown), and if wanted `kicked` (0: an opportunity without a kick), `match`, `opportunity`, `minutes` (of play of
/// that group in that match, the same in each of its rows), `distance_m`. Throws std::runtime_error naming file, line,
/// column and value, also where a group has an opportunity of a match twice (without `match`: where they are paired);
/// UsageError where groups or situations are to be the outcome or a column that the table has not.
evaluator::KickDataset read_kicks(std::istream& in, const std::string& file, const CsvComparison& options);

}  // namespace trivela::cli
