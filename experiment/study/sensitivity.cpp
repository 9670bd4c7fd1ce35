#include "experiment/study/sensitivity.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::experiment {

Effect headline(const std::vector<ArmTally>& arms, std::size_t i, Measure measure) {
  const Term terms[] = {{&arms.at(i + 1), 1.0}, {&arms.at(i), -1.0}};
  return contrast(terms, measure);
}

Effect change(const SensitivityReport& report, const PlayedEnd& end, std::size_t i) {
  const Term terms[] = {
      {&end.arms.at(i + 1), 1.0}, {&end.arms.at(i), -1.0}, {&report.base.at(i + 1), -1.0}, {&report.base.at(i), 1.0}};
  return contrast(terms, report.measure);
}

double largest_change(const SensitivityReport& report, const PlayedInput& input) {
  double largest = 0.0;
  for (const PlayedEnd& end : input.ends) {
    for (std::size_t i = 0; i + 1 < report.arms.size(); ++i)
      largest = std::max(largest, std::abs(change(report, end, i).value));
  }
  return largest;
}

void sort_by_change(SensitivityReport& report) {
  std::ranges::stable_sort(report.inputs, std::ranges::greater{},
                           [&](const PlayedInput& input) { return largest_change(report, input); });
}

}  // namespace trivela::experiment
