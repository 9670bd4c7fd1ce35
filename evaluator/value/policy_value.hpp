#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "evaluator/counting/log_opportunities.hpp"
#include "evaluator/stats/off_policy.hpp"

namespace trivela::evaluator {

/// What a policy would have had, judged from opportunities whose policy was drawn at random.
struct PolicyValueReport {
  std::string policy;
  stats::OffPolicy value;          ///< shots on target an opportunity
  std::int64_t opportunities = 0;  ///< in the log
  std::int64_t not_drawn = 0;      ///< left out: in their configuration, or by their robot, the policy was never drawn
  std::int64_t unknown = 0;        ///< whose outcome is unknown; counted as not on target
  bool from_decisions = false;     ///< the model of outcomes knows what the robot believed; otherwise the true start
  bool simulated = false;
  std::string outcome = "observed";
  std::vector<std::string> remarks;
};

/// Throws std::runtime_error with the reason where the log cannot say it: nothing drawn at random, the policy never
/// drawn, or fewer than stats::kFewestEffective effective opportunities.
PolicyValueReport evaluate_policy(const LoggedOpportunities& logged, const std::string& policy, bool truth);

std::string to_text(const PolicyValueReport& report);

/// Its first sentence, and what forbids to trust it.
std::string to_short_text(const PolicyValueReport& report);

/// Keys: policy, outcome, ips, snips, doubly_robust (each value, ci95), logged, trials, by_policy, matches, by_match,
/// effective_sample_size, largest_weight, mean_weight, mean_weight_p, opportunities, not_drawn, unknown, model,
/// simulated, remarks.
std::string to_json(const PolicyValueReport& report);

}  // namespace trivela::evaluator
