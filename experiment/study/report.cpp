#include "experiment/study/report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace trivela::experiment {

std::string effect_text(const Effect& effect, double scale, const std::string& form) {
  if (!std::isfinite(effect.value)) return "-";
  const auto number = [&](double value) { return fmt::format(fmt::runtime(form), scale * value); };
  return fmt::format("{} ({})", number(effect.value),
                     has_interval(effect) ? fmt::format("{} to {}", number(effect.ci.lo), number(effect.ci.hi)) : "-");
}

std::string share_text(const Effect& effect) { return effect_text(effect, 100.0, "{:.1f}"); }

std::string points_text(const Effect& effect) { return effect_text(effect, 100.0, "{:+.1f}"); }

Json json_of(const Effect& effect) {
  if (!std::isfinite(effect.value)) return nullptr;
  return {{"value", effect.value}, {"ci", has_interval(effect) ? evaluator::json_of(effect.ci) : Json()}};
}

std::string label_warning(const std::string& arm, const ArmTally& observed) {
  if (total_of(observed).kicks == 0) return {};
  ArmTally truth = observed;
  for (MatchTally& match : truth) match.on_target = match.true_on_target;
  const Effect said = share_of(observed, Measure::kPerOpportunity), is = share_of(truth, Measure::kPerOpportunity);
  if (!has_interval(said) || (is.value >= said.ci.lo && is.value <= said.ci.hi)) return {};
  return fmt::format(
      "{}: many labels are wrong or unknown: {:.4f} ({:.4f} to {:.4f}) on target an opportunity by the observer, "
      "{:.4f} "
      "by the simulator's truth\n",
      arm, said.value, said.ci.lo, said.ci.hi, is.value);
}

}  // namespace trivela::experiment
