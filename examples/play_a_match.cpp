// Plays the same possessions with two policies, in this process, and prints their kicks as the paper's Table 2 does.
#include <fmt/core.h>

#include "evaluator/render/text_table.hpp"
#include "evaluator/table2/table2.hpp"
#include "experiment/play/play_match.hpp"

namespace evaluator = trivela::evaluator;
namespace experiment = trivela::experiment;
namespace kicking = trivela::kicking;

int main() {
  std::vector<std::vector<std::string>> table{{"policy", "inside", "outside", "efficiency", "Wilson 95 %"}};
  for (const auto policy : {kicking::PolicyName::kStopped, kicking::PolicyName::kMoving}) {
    experiment::Arm arm;
    arm.policy = policy;
    experiment::MatchRecord match;
    experiment::play_match(trivela::sim::Scenario{}, arm, /*seed=*/1, /*match_id=*/0, 200, {}, &match);

    evaluator::PolicyRow row;
    for (const auto& outcome : match.outcomes) ++row.kicks_by_outcome[trivela::msg::label(outcome.outcome)];
    table.push_back({kicking::name(policy), fmt::format("{}", row.inside()), fmt::format("{}", row.outside()),
                     evaluator::percent(evaluator::stats::efficiency(row.counts()).value_or(0.0)),
                     evaluator::percent(row.efficiency_ci())});
  }
  fmt::print("{}{}", evaluator::kSimulated, evaluator::text_table(table));
}
