#include <fmt/format.h>

#include "evaluator/compare/comparison_lines.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/render/simulated.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/stats/test_plan.hpp"
#include "evaluator/value/policy_value.hpp"

namespace trivela::evaluator {
namespace {

std::vector<std::string> row(const std::string& name, const stats::PolicyValue& value) {
  return {name, percent(value.value), percent(value.ci)};
}

constexpr const char* kWrongWeights =
    "The policies were not drawn with the probabilities of the log: trust nothing here before that is explained.";

std::string value_sentence(const PolicyValueReport& r) {
  const stats::OffPolicy& v = r.value;
  return wrapped(
      fmt::format("{} would have had a shot on target in {} of these opportunities, 95 % {} (doubly robust); "
                  "as they were played it was {}.",
                  r.policy, percent(v.doubly_robust.value), percent(v.doubly_robust.ci), percent(v.logged)),
      "  ");
}

Json value_json(const stats::PolicyValue& value) {
  return {{"value", value.value}, {"ci95", evaluator::json_of(value.ci)}};
}

}  // namespace

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
