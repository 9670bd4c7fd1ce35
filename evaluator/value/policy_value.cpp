#include "evaluator/value/policy_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/stats/test_plan.hpp"

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
        "and what came of it cannot be told from what else the half was; a robot of today counts its own gains of the "
        "ball",
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

std::vector<std::string> row(const std::string& name, const stats::PolicyValue& value) {
  return {name, percent(value.value), percent(value.ci)};
}

constexpr const char* kWrongWeights =
    "The policies were not drawn with the probabilities of the log: trust nothing here before that is explained.";

std::string value_sentence(const PolicyValueReport& r) {
  const stats::OffPolicy& v = r.value;
  return wrapped(fmt::format("{} would have had a shot on target in {} of these opportunities, 95 % {} (doubly "
                             "robust); as they were played it was {}.",
                             r.policy, percent(v.doubly_robust.value), percent(v.doubly_robust.ci), percent(v.logged)),
                 "  ");
}

Json value_json(const stats::PolicyValue& value) {
  return {{"value", value.value}, {"ci95", evaluator::json_of(value.ci)}};
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

std::string to_short_text(const PolicyValueReport& r) {
  const stats::OffPolicy& v = r.value;
  std::string text = (r.simulated ? kSimulated : "") + value_sentence(r) + "\n";
  text +=
      fmt::format("  {} opportunities, {:.1f} effective; how else it can be estimated, and what that rests on: --all\n",
                  v.trials, v.effective_sample_size);
  if (v.mean_weight_p < stats::kSampleRatioAlarm) text += bullet(kWrongWeights);
  return text;
}

std::string to_text(const PolicyValueReport& r) {
  const stats::OffPolicy& v = r.value;
  std::string text;
  if (r.simulated) text += kSimulated;
  text += value_sentence(r) + "\n\nOn target an opportunity\n";
  text += text_table({{"estimate", "value", "95 %"},
                      row("inverse probability", v.ips),
                      row("the same, normalised", v.snips),
                      row("doubly robust", v.doubly_robust)});
  text += "\nWhat it rests on\n";
  text += named_line("drawn at random", fmt::format("{} opportunities of {} matches", v.trials, v.matches));
  text += named_line("of them by the policy", fmt::format("{}", v.by_target));
  text += named_line("effective", fmt::format("{:.1f} opportunities, largest weight {:.1f}", v.effective_sample_size,
                                              v.largest_weight));
  text += named_line("mean weight", fmt::format("{:.3f}, 1 where policies were drawn as the log says (p {})",
                                                v.mean_weight, p_value(v.mean_weight_p)));
  text += named_line("model of outcomes",
                     r.from_decisions ? "distance, place and opponent as the robot believed at its first decision"
                                      : "true distance and place at the start of the possession");
  text += named_line("outcomes", r.outcome == "truth" ? "the simulator's truth" : "as the robots observed them");
  if (r.not_drawn > 0) {
    text += bullet(
        fmt::format("{} opportunities left out: in their configuration, or by their robot, the policy was never drawn.",
                    r.not_drawn));
  }
  if (r.unknown > 0)
    text += bullet(fmt::format("{} kicks whose outcome is unknown count as not on target.", r.unknown));
  if (v.mean_weight_p < stats::kSampleRatioAlarm) {
    text += bullet(kWrongWeights);
  }
  if (!v.by_match) {
    text += bullet(
        "Fewer than five matches: the intervals take opportunities as independent, so the truth is less certain.");
  }
  for (const std::string& remark : r.remarks) text += bullet(remark);
  return text;
}

std::string to_json(const PolicyValueReport& r) {
  const stats::OffPolicy& v = r.value;
  const Json json = {{"policy", r.policy},
                     {"outcome", r.outcome},
                     {"ips", value_json(v.ips)},
                     {"snips", value_json(v.snips)},
                     {"doubly_robust", value_json(v.doubly_robust)},
                     {"logged", v.logged},
                     {"trials", v.trials},
                     {"by_policy", v.by_target},
                     {"matches", v.matches},
                     {"by_match", v.by_match},
                     {"effective_sample_size", v.effective_sample_size},
                     {"largest_weight", v.largest_weight},
                     {"mean_weight", v.mean_weight},
                     {"mean_weight_p", v.mean_weight_p},
                     {"opportunities", r.opportunities},
                     {"not_drawn", r.not_drawn},
                     {"unknown", r.unknown},
                     {"model", r.from_decisions ? "first decision" : "true start"},
                     {"simulated", r.simulated},
                     {"remarks", r.remarks}};
  return json_text(json);
}

}  // namespace trivela::evaluator
