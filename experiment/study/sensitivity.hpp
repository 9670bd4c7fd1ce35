#pragma once

#include <string>
#include <vector>

#include "experiment/study/inputs.hpp"
#include "experiment/study/report.hpp"

namespace trivela::experiment {

/// An input at one of its two values, played.
struct PlayedEnd {
  double value = 0.0;
  std::vector<ArmTally> arms;  ///< in the order of the report's; the same match numbers as without the change
};

/// An input with what it does.
struct PlayedInput {
  UncertainInput input{};
  double value = 0.0;           ///< the scenario's
  std::vector<PlayedEnd> ends;  ///< low and high; without those that are the scenario's own value
};

/// What a run found, and under which assumptions.
struct SensitivityReport {
  StudyPlayed played{};
  std::vector<std::string> arms{};  ///< names, at least two
  std::vector<ArmTally> base{};     ///< the scenario as it is
  std::vector<PlayedInput> inputs{};
  Measure measure = Measure::kPerOpportunity;  ///< or kGoals
};

/// Headline i: shots on target per opportunity, or goals, arm i + 1 minus arm i. There is one less than there are arms.
Effect headline(const std::vector<ArmTally>& arms, std::size_t i, Measure measure = Measure::kPerOpportunity);

/// Headline i at an end minus headline i of the scenario, on the same opportunities.
Effect change(const SensitivityReport& report, const PlayedEnd& end, std::size_t i);

/// The largest change of any headline at any end, without its sign: what the inputs are sorted by.
double largest_change(const SensitivityReport& report, const PlayedInput& input);

/// Largest first.
void sort_by_change(SensitivityReport& report);

/// A row an arm of the scenario as it is, and an arm of each input at each end, with the change of its headline.
std::vector<StudyRow> rows_of(const SensitivityReport& report);
std::string to_text(const SensitivityReport& report);
Json to_json(const SensitivityReport& report);

/// A bar for each end of each input, a panel a headline (tornado.cpp).
std::string to_svg(const SensitivityReport& report);

}  // namespace trivela::experiment
