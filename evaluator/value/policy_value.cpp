#include "evaluator/value/policy_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace trivela::evaluator {
namespace {

constexpr double kFarOpponent_m = 6.0;  // an opponent not seen, or further away, matters to nobody

bool drawn(const LoggedOpportunity& o) { return o.probability && *o.probability > 0.0 && *o.probability < 1.0; }

stats::Context context_of(const LoggedOpportunity& o, bool from_decisions) {
  if (!from_decisions) return {o.start_distance_m.value_or(0.0), std::abs(o.start_x_m.value_or(0.0)), 0.0, 0.0};
  if (!o.first) return {0.0, 0.0, kFarOpponent_m, 1.0};  // nobody ever decided: the ball was gone at once
  return {o.first->distance_m, std::abs(o.first->x_m),
          std::min(o.first->opponent_distance_m.value_or(kFarOpponent_m), kFarOpponent_m), 0.0};
}

std::string refusal(const LoggedOpportunities& logged, const std::string& policy,
                    const std::map<std::string, std::int64_t>& counts) {
  if (logged.rows.empty()) return "the log has no opportunities";
  if (counts.empty() && logged.draws_of_halves > 0) {
    return fmt::format(
        "policies were drawn at random, but nobody counted possessions: each of the {} draws held for a whole half, "
        "and "
        "what came of it cannot be told from what else the half was; a robot of today counts its own gains of the ball",
        logged.draws_of_halves);
  }
  if (counts.empty()) {
    return "no policy was drawn at random in this log: every decision was certain, so what another policy would have "
           "done there was never tried (no overlap); play with random assignment, even 10 % is enough";
  }
  std::vector<std::string> names;
  names.reserve(counts.size());
  for (const auto& [name, n] : counts) names.push_back(fmt::format("{} {} times", name, n));
  return fmt::format("the policy '{}' was never drawn at random (no overlap); drawn were {}", policy,
                     fmt::join(names, ", "));
}

}  // namespace

PolicyValueReport evaluate_policy(const LoggedOpportunities& logged, const std::string& policy, bool truth) {
  PolicyValueReport report;
  report.policy = policy;
  report.outcome = truth ? "truth" : "observed";
  report.remarks = logged.remarks;
  // One plan of drawing: a configuration and a robot.
  const auto plan_of = [&](const LoggedOpportunity& o) {
    return std::pair(logged.sessions[o.session].config_sha256, o.robot_id);
  };
  std::set<std::pair<std::string, int>> plans;
  std::map<std::string, std::int64_t> counts;
  for (const LoggedOpportunity& o : logged.rows) {
    report.opportunities += o.has_possession ? 1 : 0;
    report.simulated = report.simulated || logged.sessions[o.session].simulated;
    if (!drawn(o)) continue;
    ++counts[o.policy];
    if (o.policy == policy) plans.insert(plan_of(o));
    report.from_decisions = report.from_decisions || o.first;
  }
  if (plans.empty()) throw std::runtime_error(refusal(logged, policy, counts));
  std::vector<stats::Trial> trials;
  for (const LoggedOpportunity& o : logged.rows) {
    if (!o.has_possession) continue;
    if (!drawn(o) || !plans.contains(plan_of(o))) {
      ++report.not_drawn;
    } else {
      report.unknown += o.ending == Ending::kUnknown ? 1 : 0;
      trials.push_back({.by_target = o.policy == policy,
                        .probability = *o.probability,
                        .reward = o.ending == Ending::kInside ? 1.0 : 0.0,
                        .match = logged.sessions[o.session].match,
                        .context = context_of(o, report.from_decisions)});
    }
  }
  if (const double effective = stats::effective_sample_size(trials); effective < stats::kFewestEffective) {
    throw std::runtime_error(
        fmt::format("only {:.1f} effective opportunities of '{}' among {} that were drawn; {:.0f} are needed",
                    effective, policy, trials.size(), stats::kFewestEffective));
  }
  report.value = stats::off_policy_value(trials);
  return report;
}

}  // namespace trivela::evaluator
