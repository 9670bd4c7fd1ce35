#include "evaluator/compare/policy_comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace trivela::evaluator {
namespace {

/// The opportunities of one group. Minutes of play are not told apart by group, and are none.
LoggedOpportunities of_group(const LoggedOpportunities& logged, const std::string& by, const std::string& group) {
  LoggedOpportunities part;
  part.logs = logged.logs;
  part.sessions = logged.sessions;
  part.matches = logged.matches;
  part.draws_of_halves = logged.draws_of_halves;
  for (const LoggedOpportunity& o : logged.rows) {
    if ((by == "arm" ? logged.sessions[o.session].arm : o.policy) == group) part.rows.push_back(o);
  }
  return part;
}

BetweenLogs of_part(const LoggedOpportunities& part, const std::string& group, const LogKicks& options,
                    double smallest_effect) try {
  BetweenLogs between{group, nullptr, ""};
  std::string by;
  KickDataset dataset = kick_dataset_of(part, options, by);
  if (dataset.groups.size() == 1) {
    between.why_none = fmt::format("in {} alone", dataset.groups.front());
  } else {
    between.comparison = std::make_shared<PolicyComparison>(compare_policies(std::move(dataset), by, smallest_effect));
  }
  return between;
} catch (const std::runtime_error& error) {
  return {group, nullptr, error.what()};
}

}  // namespace

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

std::vector<BetweenLogs> between_logs(const LoggedOpportunities& logged, std::span<const std::string> groups,
                                      const std::string& by, LogKicks options, double smallest_effect) {
  options.by = "log";
  if (options.stratify == "log" || options.stratify == by) options.stratify.clear();  // one of each is left
  std::vector<BetweenLogs> all;
  std::vector<PairResult*> pairs;
  for (const std::string& group : groups) {
    const BetweenLogs& between =
        all.emplace_back(of_part(of_group(logged, by, group), group, options, smallest_effect));
    if (!between.comparison) continue;
    for (PairResult& pair : between.comparison->pairs) pairs.push_back(&pair);
  }
  adjust_together(pairs);
  return all;
}

std::string between_logs_text(std::span<const BetweenLogs> between) {
  std::string text, design;
  std::size_t comparisons = 0;
  for (const BetweenLogs& group : between) comparisons += group.comparison ? group.comparison->pairs.size() : 0;
  for (const BetweenLogs& group : between) {
    if (!group.comparison) {
      text += fmt::format("  {}: {}\n", group.group, group.why_none);
      continue;
    }
    for (const PairResult& pair : group.comparison->pairs) {
      text += fmt::format("  {}: {}", group.group, short_line_of(pair, *group.comparison, comparisons));
      design = design_sentence(pair, *group.comparison);
    }
  }
  if (text.empty()) return "";
  return "One log against the other\n" + text + (design.empty() ? "" : bullet(design));
}

}  // namespace trivela::evaluator
