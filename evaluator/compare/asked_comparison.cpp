#include "evaluator/compare/asked_comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace trivela::evaluator {

void check(const ComparisonQuestion& question) {
  if (!(question.smallest_effect > 0.0 && question.smallest_effect < 1.0)) {
    throw BadChoice(
        fmt::format("smallest-effect {}: write percentage points between 0 and 100", 100.0 * question.smallest_effect));
  }
  if (!question.design.empty() && !design_of(question.design)) {
    throw BadChoice(
        fmt::format("design {}: expected one of: before_after, alternating, randomised, paired", question.design));
  }
}

PolicyComparison compare_dataset(KickDataset dataset, const std::string& by, const ComparisonQuestion& question) {
  if (question.kicks.stratify == by) {
    throw BadChoice(fmt::format("stratify {}: within one {} there is nothing to compare", by, by));
  }
  if (!question.baseline.empty() && !put_first(dataset, question.baseline)) {
    throw BadChoice(
        fmt::format("baseline '{}': there is no such {} ({})", question.baseline, by, fmt::join(dataset.groups, ", ")));
  }
  if (!question.design.empty()) {
    dataset.design = *design_of(question.design);
    dataset.design_reason = "as --design says";
  }
  return compare_policies(std::move(dataset), by, question.smallest_effect);
}

PolicyComparison compare_logs(const std::vector<std::filesystem::path>& logs, const ComparisonQuestion& question) {
  const LoggedOpportunities logged = read_opportunities(logs, question.kicks.truth);
  std::string by;
  PolicyComparison comparison = compare_dataset(kick_dataset_of(logged, question.kicks, by), by, question);
  for (const std::filesystem::path& log : logs) comparison.logs.push_back(log.string());
  if (logs.size() > 1) comparison.differences = log_differences(logs);
  if (logs.size() != 2 || (by != "policy" && by != "arm")) return comparison;
  std::vector<std::string> groups;
  for (const GroupResult& group : comparison.groups) groups.push_back(group.name);
  comparison.between = between_logs(logged, groups, by, question.kicks, comparison.smallest_effect);
  return comparison;
}

}  // namespace trivela::evaluator
